"""How well a drawing explains a log: the evidence of the localizer along the way."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

from pilotage.geometry import Pose2
from pilotage.localization import Localizer, LocalizerSettings, Observation, OtherBuildings, observe
from pilotage.maps import Atlas
from pilotage.perception import Reading
from pilotage.scan_matching import ScanMatcher


@dataclass(frozen=True, slots=True)
class Evidence:
    """What one drawing tells about one log."""

    log_evidence: float  # of the drawing over that of other buildings [nats]
    place: str  # where the robot would be at the end
    probability: float  # of that place


def observations_of(
    readings: Iterable[Reading], travel: float, settings: LocalizerSettings
) -> tuple[Observation, ...]:
    """Take the keyframes of the first metres of a log: the robot's side, the same for all drawings.

    Raises ValueError if there is no scan.
    """
    matcher, other_buildings = ScanMatcher(settings.scan_matching), OtherBuildings(settings.sensor)
    observations: list[Observation] = []
    motion, gone = Pose2.identity(), 0.0
    for reading in readings:
        seen = matcher.update(reading.scan, reading.odometry)
        gone += math.hypot(seen.last_from_base.x, seen.last_from_base.y)
        motion = motion @ seen.last_from_base
        if not observations or seen.was_carried or settings.is_keyframe_due(motion):
            keyframe = observe(reading.scan, seen.shapes, motion, was_carried=seen.was_carried)
            observations.append(other_buildings.compared(keyframe))
            motion = Pose2.identity()
        if gone >= travel:
            break
    if not observations:
        raise ValueError("a log needs a scan, got none")
    return tuple(observations)


def weigh(
    atlas: Atlas, observations: Iterable[Observation], settings: LocalizerSettings, seed: int
) -> Evidence:
    """Localize on a drawing along the way, and sum up the evidence; there must be an observation."""
    localizer = Localizer(atlas, settings, seed=seed)
    for seen in observations:
        localizer.add_keyframe(seen)
    estimate = localizer.estimate
    return Evidence(localizer.log_evidence, estimate.place, estimate.probability)


def reduced(settings: LocalizerSettings, share: float, fineness: float = 1.0) -> LocalizerSettings:
    """Return settings with a share of the particles and proposals, and with coarser ranges of the drawing."""
    tracks, table = settings.tracks, settings.atlas.range_table

    def some(count: int, share: float = share) -> int:
        return max(1, round(share * count))

    return replace(
        settings,
        atlas=replace(settings.atlas, range_table=replace(table, cells=some(table.cells, fineness))),
        proposals=max(100, some(settings.proposals)),
        tracks=replace(
            tracks,
            first_count=some(tracks.first_count),
            max_count=some(tracks.max_count),
            min_count=some(tracks.min_count),
            count_per_area=some(tracks.count_per_area),
        ),
    )
