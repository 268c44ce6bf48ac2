"""Cells of a drawing, their gateways, and a route through them (Wolter 2001, section 4.1)."""

import colorsys

import numpy as np
import rustworkx
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.patheffects import withStroke

from pilotage.figures import style
from pilotage.figures.drawing import draw_strokes
from pilotage.maps import Cell, CellGraph, Route, SchematicMap

PAGE_WIDTH, PAGE_TALLEST = 9.6, 9.0  # [inches]
HUES = (0.55, 0.11, 0.36, 0.93, 0.75, 0.47, 0.02, 0.64, 0.19, 0.84)
"""Neighbors take different ones, the first as often as possible."""
LIGHTNESS, SATURATION = 0.87, 0.5
POINTS_A_INCH = 72.0
NAME_SHARE = 0.6  # of a cell's width may be filled by its name
GLYPH_WIDTH = 0.6  # of a letter, in font sizes
LEAST_TEXT, MOST_TEXT = 4.5, 9.5  # [points]
MARK = 14.0  # [points] how far a name keeps from the start and goal


def cells_figure(
    sketch: SchematicMap, graph: CellGraph, *, route: Route | None = None, title: str = ""
) -> Figure:
    """Draw cells in colors that tell neighbors apart, gateways, walls, and a route."""
    left, bottom, right, top = sketch.bounds
    aspect = style.proportion(right - left, top - bottom)
    width = min(PAGE_WIDTH, PAGE_TALLEST / aspect)
    figure = style.new_figure(width + 0.6, width * aspect + 1.2)
    axes = style.place(figure, 0.3, 0.6, width, width * aspect)
    draw_cells(axes, graph, set(route.cell_ids) if route is not None else set())
    draw_strokes(axes, sketch.strokes, linewidth=1.5)
    draw_gateways(axes, graph)
    if route is not None:
        draw_route(axes, route)
    draw_names(axes, graph, width / (right - left or 1.0) * POINTS_A_INCH, route)
    style.frame(axes, np.array([left, bottom]), np.array([right, top]), margin=0.02)
    style.bare(axes, title)
    axes.legend(
        loc="upper left", bbox_to_anchor=(0.0, -0.01), ncols=3, frameon=False, fontsize=style.SMALL,
        borderaxespad=0.0,
    )  # fmt: skip
    return figure


def draw_cells(axes: Axes, graph: CellGraph, visited: set[str]) -> None:
    """Fill the cells; those of a route stronger, if there is one."""
    for cell, hue in zip(graph.cells, hues_of(graph), strict=True):
        saturation = SATURATION if not visited or cell.cell_id in visited else 0.15
        color = colorsys.hls_to_rgb(hue, LIGHTNESS, saturation)
        axes.add_patch(PathPatch(outline_of(cell), facecolor=color, edgecolor="none", zorder=1))


def hues_of(graph: CellGraph) -> list[float]:
    """Choose a hue for each cell so that neighbors differ."""
    network = rustworkx.PyGraph(multigraph=False)
    network.add_nodes_from(range(len(graph.cells)))
    index = graph.index_from_id
    network.add_edges_from_no_data(
        [(index[gateway.cell_ids[0]], index[gateway.cell_ids[1]]) for gateway in graph.gateways]
    )
    shades = rustworkx.graph_greedy_color(network)
    return [HUES[shades[node] % len(HUES)] for node in network.node_indices()]


def outline_of(cell: Cell) -> Path:
    """Join the outline of a cell and its holes to one path."""
    rings = [np.vstack([ring, ring[:1]]) for ring in (cell.outline, *cell.holes)]
    codes = [[Path.MOVETO, *[Path.LINETO] * (len(ring) - 2), Path.CLOSEPOLY] for ring in rings]
    return Path(np.concatenate(rings), np.concatenate(codes).astype(Path.code_type))


def draw_gateways(axes: Axes, graph: CellGraph) -> None:
    """Draw the gateways from wall to wall."""
    for number, gateway in enumerate(graph.gateways):
        axes.plot(
            *gateway.segment.T, color=style.ACCENT, linewidth=2.2, solid_capstyle="round", zorder=8,
            label="gateway" if number == 0 else None,
        )  # fmt: skip


def draw_route(axes: Axes, route: Route) -> None:
    """Draw the way from its start (a ring) to its goal (a disc)."""
    axes.plot(
        *route.way.T, color="white", linewidth=5.0, solid_capstyle="round", solid_joinstyle="round", zorder=9
    )
    axes.plot(
        *route.way.T, color=style.TRAIL, linewidth=2.6, solid_capstyle="round", solid_joinstyle="round",
        zorder=10, label=f"route through {len(route.cell_ids)} cells, cost {route.cost:.2f}",
    )  # fmt: skip
    for (x, y), face, word in ((route.way[0], "white", "start"), (route.way[-1], style.TRAIL, "goal")):
        axes.scatter(
            [x], [y], s=70.0, color=face, edgecolor=style.TRAIL, linewidths=2.2, zorder=11, label=word
        )


def draw_names(axes: Axes, graph: CellGraph, points_a_unit: float, route: Route | None) -> None:
    """Write into each cell its label, else its id, below the start or goal if that stands there."""
    marks = np.empty((0, 2)) if route is None else route.way[[0, -1]]
    for cell in graph.cells:
        lines = cell.label.split(", ") if cell.label else [cell.cell_id]
        room = 2.0 * float(cell.polygon.boundary.distance(cell.polygon.centroid)) if not cell.holes else 0.0
        width = max(room, np.sqrt(cell.polygon.area) / 2.0) * points_a_unit * NAME_SHARE
        size = np.clip(width / (GLYPH_WIDTH * max(map(len, lines))), LEAST_TEXT, MOST_TEXT)
        near = np.hypot(*(marks - cell.center).T).min(initial=np.inf) * points_a_unit < MARK
        axes.annotate(
            "\n".join(lines), cell.center, (0.0, -MARK if near else 0.0), textcoords="offset points",
            fontsize=float(size), color=style.INK, ha="center", va="center", linespacing=1.15, zorder=12,
            parse_math=False,
            path_effects=[withStroke(linewidth=1.6, foreground="white", alpha=0.8)],
        )  # fmt: skip
