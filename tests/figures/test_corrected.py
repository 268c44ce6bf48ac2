"""The picture of a corrected drawing."""

import numpy as np
import shapely

from pilotage.correction import CorrectedDrawing, Passage, PassageState
from pilotage.correction.spline import ElasticMap, SplineGrid
from pilotage.figures.corrected import corrected_figure
from pilotage.geometry import Polyline, Pose2, Similarity2
from pilotage.maps import SchematicMap

WALLS = Polyline.through([(3, 2.5), (3, 4), (0, 4), (0, 0), (3, 0), (3, 1.5)])
ASIDE = Polyline.through([(3, 4), (7, 4), (7, 0), (3, 0)])


def test_it_shows_both_drawings_and_what_was_seen():
    grid = SplineGrid.over(np.array([[0.0, 0.0], [7.0, 4.0]]), 1.0, 1_000)
    sketch = SchematicMap((WALLS, ASIDE))
    corrected = CorrectedDrawing(
        sketch,
        (WALLS,),
        (ASIDE,),
        (Passage("g0", [[3.0, 1.5], [3.0, 2.5]], PassageState.CLOSED),),
        (shapely.box(0, 0, 3, 4),),
        np.zeros((2, 3)),
        ElasticMap(Similarity2(1.0, Pose2.identity()), grid, grid.nodes),
        0.1,
    )

    figure = corrected_figure(sketch, corrected, true_hits=WALLS.vertices)

    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert words == ["the robot's way", "seen", "never seen", "found closed"]
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["as drawn", "as found, 1 units a metre"]
