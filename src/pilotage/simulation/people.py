"""People who walk to and fro."""

from dataclasses import dataclass

from pilotage.geometry import Polyline


@dataclass(frozen=True, slots=True)
class Person:
    """Walks along a path and back; a closed path is walked round and round."""

    path: Polyline  # [m]
    speed: float = 1.0  # [m/s]
    radius: float = 0.25  # [m]

    def __post_init__(self) -> None:
        """Refuse who cannot walk."""
        for name in ("speed", "radius"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"a person's {name} must be > 0, got {getattr(self, name)}")
