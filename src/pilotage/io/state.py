"""Save what a localizer believes when a robot stops, and resume from it when it starts again.

A state is a zip file of arrays (numpy's npz, not compressed) and one of JSON, `state.json`, in which frozen
values are objects with their type's name. Nothing in it is run.
"""

import io
import json
import zipfile
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

from pilotage.correction import Sighting
from pilotage.errors import FileError, PilotageError, shown
from pilotage.geometry import Affine2, Homography, Polyline, Pose2
from pilotage.io.files import read_bytes, replacing
from pilotage.localization import (
    BlockedWay,
    Estimate,
    Localizer,
    LocalizerSettings,
    PoseHypothesis,
    Status,
)
from pilotage.localization.belief import Belief
from pilotage.localization.keyframes import Keyframe
from pilotage.localization.other_buildings import ElsewhereState
from pilotage.localization.particle_filter import Posterior
from pilotage.localization.particles import Particles
from pilotage.localization.sensor_model import SparseScan
from pilotage.localization.state import LocalizerState
from pilotage.localization.tracks import Track, Tracks
from pilotage.maps import Atlas, FileAxes, SchematicMap
from pilotage.perception import Odometry
from pilotage.scan_matching.local_map import LocalMap
from pilotage.scan_matching.odometry import OdometryNoise
from pilotage.shape import PartialShape
from pilotage.shape.corners import Corners
from pilotage.shape.partial import EndCause

VERSION = 4
"""Of the format; a state of another version is refused."""

LARGEST = 1 << 27
"""The largest state that is read [bytes]; one of 30,000 particles has 2 MB."""

DAMAGED = "this is no saved state, or it is damaged"

TREE = "state.json"
NAMED, ARRAY, FREE = "type", "array", "items"
"""Keys of the objects of the tree: a frozen value, an array, and a mapping."""

TYPES: Mapping[str, type] = {
    kind.__name__: kind
    for kind in (
        Affine2, Belief, BlockedWay, Corners, ElsewhereState, EndCause, Estimate, FileAxes, Homography,
        Keyframe, LocalMap, LocalizerState, Odometry, OdometryNoise, PartialShape, Particles, Polyline, Pose2,
        PoseHypothesis, Posterior, Sighting, SparseScan, Status, Track, Tracks,
    )
}  # fmt: skip
"""All types that a state may hold."""


@dataclass(frozen=True, eq=False)
class SavedState:
    """What a localizer believed, the gateways that were blocked, and what corrects the drawing."""

    localizer: LocalizerState
    blocked: tuple[str, ...] = ()
    sightings: tuple[Sighting, ...] = ()


def save_state(
    path: Path | str,
    localizer: Localizer,
    blocked: Collection[str] = (),
    sightings: Sequence[Sighting] = (),
) -> None:
    """Save all that a localizer has learned; an old file is replaced.

    The ids of blocked gateways go with it, and the sightings by which the drawing is corrected. The file is
    written whole or not at all. Raises FileError if it cannot be written.
    """
    arrays: list[np.ndarray] = []
    tree = {
        "version": VERSION,
        "state": encode(localizer.state, arrays),
        "blocked": list(blocked),
        "sightings": encode(tuple(sightings), arrays),
    }
    with replacing(path) as beside, zipfile.ZipFile(beside, "w") as file:
        file.writestr(TREE, json.dumps(tree))
        for number, array in enumerate(arrays):
            content = io.BytesIO()
            np.save(content, array, allow_pickle=False)
            file.writestr(f"{number}.npy", content.getvalue())


def resume(
    path: Path | str,
    drawing: SchematicMap | Atlas,
    settings: LocalizerSettings | None = None,
    *,
    stood: bool = False,
) -> Localizer:
    """Go on from a saved state, as if the localizer had never stopped.

    With `stood` the robot is taken not to have moved since, whatever its odometry says, which may have begun
    anew. Raises FileError if the file is missing, damaged, of another version or of another drawing.
    """
    saved = read_state(path)
    try:
        return Localizer.resumed(drawing, saved.localizer, settings, stood=stood)
    except PilotageError as error:
        raise FileError(str(error), path) from error


def read_state(path: Path | str) -> SavedState:
    """Read a saved state; raises FileError if it is missing, damaged or of another version."""
    content = read_bytes(path, LARGEST)
    try:
        tree, arrays = unpack(content)
        version = tree["version"]
        state = decode(tree["state"], arrays) if version == VERSION else None
        blocked = tuple(str(name) for name in tree["blocked"])
        sightings = decode(tree.get("sightings", []), arrays) if version == VERSION else ()
    except Exception as error:  # whatever is wrong with its bytes
        raise FileError(DAMAGED, path) from error
    if version != VERSION:
        raise FileError(f"a saved state must be of version {VERSION}, got {shown(version)}", path)
    if not (isinstance(state, LocalizerState) and isinstance(sightings, tuple)):
        raise FileError(DAMAGED, path)
    if not all(isinstance(one, Sighting) for one in sightings):
        raise FileError(DAMAGED, path)
    return SavedState(state, blocked, sightings)


def unpack(content: bytes) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Read the tree and the arrays of a state; raises what the bytes make it."""
    with zipfile.ZipFile(io.BytesIO(content)) as file:
        if sum(one.file_size for one in file.infolist()) > LARGEST:
            raise ValueError("it unpacks to too much")
        arrays = {
            name: np.load(io.BytesIO(file.read(name)), allow_pickle=False)
            for name in file.namelist()
            if name != TREE
        }
        return json.loads(file.read(TREE)), arrays


def encode(value: object, arrays: list[np.ndarray]) -> object:  # one a kind
    """Turn a value into what JSON can hold; arrays are gathered."""
    if isinstance(value, np.ndarray):
        arrays.append(value)
        return {ARRAY: f"{len(arrays) - 1}.npy"}
    if isinstance(value, Enum):
        return {NAMED: type(value).__name__, "value": value.value}
    if is_dataclass(value):
        held = {one.name: encode(getattr(value, one.name), arrays) for one in fields(value)}
        return {NAMED: type(value).__name__, "fields": held}
    if isinstance(value, Mapping):
        return {FREE: {name: encode(one, arrays) for name, one in value.items()}}
    if isinstance(value, tuple):
        return [encode(one, arrays) for one in value]
    if value is None or isinstance(value, bool | int | float | str | np.generic):
        return value.item() if isinstance(value, np.generic) else value
    raise TypeError(f"a state cannot hold {type(value).__name__}")


def decode(tree: object, arrays: Mapping[str, np.ndarray]) -> object:
    """Turn what JSON held into the value that was encoded; raises KeyError or TypeError if it is none."""
    if isinstance(tree, list):
        return tuple(decode(one, arrays) for one in tree)
    if not isinstance(tree, dict):
        return tree
    if ARRAY in tree:
        return arrays[tree[ARRAY]]
    if FREE in tree:
        return {name: decode(one, arrays) for name, one in tree[FREE].items()}
    kind = TYPES[tree[NAMED]]
    if issubclass(kind, Enum):
        return kind(tree["value"])
    return kind(**{name: decode(one, arrays) for name, one in tree["fields"].items()})
