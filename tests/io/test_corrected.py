"""A corrected drawing on disk: what is written can be read again, as a drawing and as a world."""

import numpy as np
import pytest
import shapely

from pilotage.correction import CorrectedDrawing, Passage, PassageState
from pilotage.correction.spline import ElasticMap, SplineGrid
from pilotage.errors import FileError
from pilotage.geometry import Polyline, Pose2, Similarity2
from pilotage.io import open_map, open_world
from pilotage.io.corrected import write_corrected
from pilotage.maps import Label, SchematicMap, Zones

LEFT = Polyline.through([(3, 2.5), (3, 4), (0, 4), (0, 0), (3, 0), (3, 1.5)])
RIGHT = Polyline.through([(3, 4), (7, 4), (7, 0), (3, 0)])


ZONES = Zones(
    keep_out=(Polyline.through([(5, 1), (6, 1), (6, 2)]),), one_way=(Polyline.through([(2, 2), (4, 2)]),)
)


@pytest.fixture
def corrected():
    """Return two rooms with a door between them; the robot has never seen the right one."""
    grid = SplineGrid.over(np.array([[0.0, 0.0], [7.0, 4.0]]), 1.0, 1_000)
    return CorrectedDrawing(
        SchematicMap(
            (LEFT, RIGHT), labels=(Label("tea & cake", (1.5, 2.0)),), metres_per_unit=1.0, zones=ZONES
        ),
        (LEFT,),
        (RIGHT,),
        (Passage("g0", [[3.0, 1.5], [3.0, 2.5]], PassageState.OPEN),),
        (shapely.box(0, 0, 3, 4), shapely.box(3, 0, 7, 4)),
        np.zeros((1, 3)),
        ElasticMap(Similarity2(1.0, Pose2.identity()), grid, grid.nodes),
        0.1,
    )


def test_the_svg_reads_as_the_same_drawing(corrected, tmp_path):
    path = tmp_path / "corrected.svg"

    write_corrected(corrected, path)

    sketch = open_map(path)
    assert sketch.bounds == pytest.approx((0.0, 0.0, 7.0, 4.0), abs=0.2)
    assert [label.text for label in sketch.labels] == ["tea & cake"]
    assert "stroke-dasharray" in path.read_text()
    assert sketch.metres_per_unit == 1.0
    assert sketch.zones.are_kept_out(np.array([[5.9, 1.5], [5.1, 1.9]])).tolist() == [True, False]
    assert sketch.zones.one_way[0].vertices == pytest.approx(np.array([[2.0, 2.0], [4.0, 2.0]]))


@pytest.mark.parametrize("name", ["corrected.svg", "corrected.yaml"])
def test_both_files_read_as_a_world_with_an_open_door(corrected, tmp_path, name):
    write_corrected(corrected, tmp_path / name)

    world = open_world(tmp_path / name)

    free = np.array([[1.5, 2.0], [3.0, 2.0], [5.0, 2.0]])
    assert world.is_free(free, 0.2).all()
    assert not world.is_free(np.array([[3.0, 3.0], [0.0, 2.0]]), 0.2).any()


def test_another_ending_is_refused(corrected, tmp_path):
    with pytest.raises(FileError, match=r"must end in \.svg, \.yaml or \.yml"):
        write_corrected(corrected, tmp_path / "corrected.pdf")

    assert list(tmp_path.iterdir()) == []
