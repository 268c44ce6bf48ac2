"""Compiled and plain functions on arrays and numbers: none of our types, no checks.

Modules are loaded at their first use (PEP 562), so that `from pilotage import kernels` may stand at the top
of a file although numba takes a third of a second to import:

>>> from pilotage import kernels
>>> kernels.segmentation.link_returns.__name__
'link_returns'
"""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

from pilotage.kernels.cache_folder import ensure_cache_folder

if TYPE_CHECKING:
    from pilotage.kernels import (
        any_start,
        arc_correspondence,
        blocks,
        contact,
        density,
        displacement,
        enclosure,
        evolution,
        evolution_compiled,
        local_grid,
        partial_matching,
        point_to_segment,
        pose_search,
        raycast,
        samples,
        segment_correspondence,
        segment_field,
        segment_grid,
        segment_sampling,
        segmentation,
        shortest_way,
        steps,
        sweep,
        tangent,
        visibility,
    )

__all__ = [
    "any_start",
    "arc_correspondence",
    "blocks",
    "contact",
    "density",
    "displacement",
    "enclosure",
    "evolution",
    "evolution_compiled",
    "local_grid",
    "partial_matching",
    "point_to_segment",
    "pose_search",
    "raycast",
    "samples",
    "segment_correspondence",
    "segment_field",
    "segment_grid",
    "segment_sampling",
    "segmentation",
    "shortest_way",
    "steps",
    "sweep",
    "tangent",
    "visibility",
]

ensure_cache_folder()  # numba reads the setting when it is imported, which is after this line


def __getattr__(name: str) -> ModuleType:
    """Load a module of kernels."""
    if name in __all__:
        return import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
