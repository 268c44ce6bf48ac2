"""What each drawn wall says about a place, against the sensor model and by worked examples."""

import math

import numpy as np
import pytest

from buildings import coarse, flat, scan_at
from pilotage.geometry import Affine2, Polyline, Pose2, segments_of
from pilotage.localization import Localizer, SensorModel, SensorSettings, Verdict
from pilotage.localization.explanation import explain
from pilotage.localization.keyframes import Keyframe
from pilotage.localization.sensor_model import thin_scan
from pilotage.maps import SchematicMap, build_atlas
from pilotage.perception import Odometry
from pilotage.shape.corners import find_corners

ROOM = Polyline.through([(0, 0), (6, 0), (6, 4), (0, 4)], closed=True)
HERE = Affine2.from_state(2.0, 1.5, 0.3, 0.0, 0.0, 0.0)


def keyframe_at(building, pose):
    scan = scan_at(pose, beams=360, fov=math.radians(359.0), walls=building.strokes)
    return Keyframe(thin_scan(scan), find_corners([]), Pose2.identity(), 0.0)


def model_of(building):
    return SensorModel(build_atlas(building, coarse(240, 360)), SensorSettings())


def explained(seen, drawn, sketch_from_base=HERE):
    keyframe = keyframe_at(seen, Pose2(2.0, 1.5, 0.3))
    return explain("here", sketch_from_base, (keyframe,), segments_of(drawn.strokes), model_of(drawn))


def test_walls_together_say_what_the_sensor_model_says():
    building, pose = flat(), Pose2(2.0, 1.5, 0.3)
    model, keyframe = model_of(building), keyframe_at(building, pose)
    state = np.array([[pose.x], [pose.y], [pose.theta], [0.0], [0.0], [0.0]])

    walls = explain("here", HERE, (keyframe,), segments_of(building.strokes), model).walls
    told = sum(wall.log_ratio * wall.readings for wall in walls)

    settings = model.settings
    whole = float(model.log_ratio(state, keyframe.scan)[0]) + settings.null_log_ratio
    assert sum(wall.readings for wall in walls) >= 0.9 * len(keyframe.scan)
    assert told == pytest.approx(whole * len(keyframe.scan) / settings.effective_beams, abs=5.0)


def test_in_the_room_that_is_drawn_every_wall_is_seen():
    room = SchematicMap((ROOM,))

    walls = explained(room, room).walls

    assert len(walls) == 4
    assert all(wall.verdict is Verdict.SEEN and wall.shown > 0.5 for wall in walls)


def test_a_wall_that_is_not_there_is_looked_through():
    across = Polyline.through([(4, 0), (4, 4)])

    found = explained(SchematicMap((ROOM,)), SchematicMap((ROOM, across)))
    wrong = found.having(Verdict.LOOKED_THROUGH)

    assert [wall.ends[:, 0].tolist() for wall in wrong] == [[4.0, 4.0]]
    assert found.walls[-1] is wrong[0]


def test_furniture_hides_walls_and_does_not_make_them_wrong():
    shelf = Polyline.through([(2.5, 0.5), (2.5, 3.5)])

    found = explained(SchematicMap((ROOM, shelf)), SchematicMap((ROOM,)))

    assert any(wall.verdict is Verdict.HIDDEN and wall.ends[:, 0].min() == 6.0 for wall in found.walls)
    assert not found.having(Verdict.LOOKED_THROUGH)


def test_scale_and_stretch_of_the_estimate_count():
    room = SchematicMap((ROOM,))
    drawn = SchematicMap((Polyline(ROOM.vertices * 10.0, closed=True),))
    there = Affine2.from_state(20.0, 15.0, 0.3, math.log(10.0), 0.0, 0.0)

    assert len(explained(room, drawn, there).having(Verdict.SEEN)) == 4
    assert not explained(room, drawn, Affine2.from_state(20.0, 15.0, 0.3, 0.0, 0.0, 0.0)).having(Verdict.SEEN)


def test_the_localizer_explains_its_last_place():
    building = flat()
    localizer = Localizer(build_atlas(building, coarse(200, 240)), start=(2.0, 1.5, 0.3), scale=1.0)
    with pytest.raises(ValueError, match="at least one scan"):
        localizer.explain()

    estimate = localizer.update(scan_at(Pose2(2.0, 1.5, 0.3)), Odometry(0.0, Pose2.identity()))
    found = localizer.explain()

    assert found.place == estimate.place
    assert len(found.having(Verdict.SEEN)) > len(found.walls) / 2
    assert f"in view from {estimate.place}" in found.summary
