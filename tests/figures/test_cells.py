from pilotage.figures.cells import cells_figure, hues_of
from pilotage.geometry import Polyline
from pilotage.maps import (
    DecompositionSettings,
    Label,
    RouteSettings,
    SchematicMap,
    decompose,
    find_route,
)

STROKES = ([(0, 0), (10, 0), (10, 5), (0, 5), (0, 0)], [(5, 0), (5, 2)], [(5, 3), (5, 5)])
SKETCH = SchematicMap(
    tuple(Polyline.through(stroke) for stroke in STROKES), labels=(Label("kitchen", (2.0, 2.0)),)
)


def test_every_cell_and_label_is_named():
    graph = decompose(SKETCH, DecompositionSettings())
    words = {text.get_text() for text in cells_figure(SKETCH, graph).axes[0].texts}

    assert {cell.label or cell.cell_id for cell in graph.cells} == words
    assert "kitchen" in words


def test_neighbors_have_different_hues():
    graph = decompose(SKETCH, DecompositionSettings())
    first, second = hues_of(graph)

    assert first != second


def test_the_legend_tells_what_is_drawn():
    graph = decompose(SKETCH, DecompositionSettings())
    route = find_route(graph, (1.0, 1.0), (9.0, 1.0), RouteSettings())
    legend = cells_figure(SKETCH, graph, route=route).axes[0].get_legend()
    words = [text.get_text() for text in legend.get_texts()]

    assert ["gateway", "start", "goal"] == [word for word in words if not word.startswith("route")]
    assert f"route through 2 cells, cost {route.cost:.2f}" in words
