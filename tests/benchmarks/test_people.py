import numpy as np
import pytest
from benchmarks.lib.people import read_matches, regions
from benchmarks.lib.rungs import is_rung, is_straight, rung_name, straight_name

MATCHES = """# sketch.png plan.png
# 0match set
# map1
10 20
# map2
100 200
110 220

# 1match set
# map1
30 40
# map2
300 400

# 2match set
# map1
# map2
"""


@pytest.fixture
def matches(tmp_path):
    path = tmp_path / "gt_00_model_simple.dat"
    path.write_text(MATCHES)
    return read_matches(path)


def test_matches_are_read_as_x_and_y_and_empty_ones_are_left_out(matches):
    on_sketch, on_plan = matches

    assert {"0", "1"} == set(on_sketch) == set(on_plan)
    np.testing.assert_array_equal([[20.0, 10.0]], on_sketch["0"])
    np.testing.assert_array_equal([[200.0, 100.0], [220.0, 110.0]], on_plan["0"])


def test_a_place_belongs_to_the_region_of_the_nearest_centre(matches):
    on_plan = regions(matches[1])

    assert ("0", "0", "1") == on_plan.names_at(np.array([[201.0, 99.0], [0.0, 0.0], [390.0, 290.0]]))


def test_a_rung_is_told_from_other_hands():
    assert "ladder-0.5-3" == rung_name(0.5, 3)
    assert is_rung(rung_name(1.0, 0))
    assert not is_rung("freehand")
    assert not is_rung(straight_name(rung_name(0.5, 3)))
    assert is_straight(straight_name("freehand"))
