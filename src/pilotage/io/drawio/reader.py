"""Read a page of a draw.io file, in the coordinates of the page."""

from pathlib import Path

from pilotage.interpretation.names import thing_called
from pilotage.interpretation.sheet import BLACK, WHITE, Color, Pen, Sheet
from pilotage.io.colors import read_color
from pilotage.io.drawio.cells import Box, Cell, Cells, number, read_cells
from pilotage.io.drawio.document import read_diagrams, read_model
from pilotage.io.drawio.edges import edge_way
from pilotage.io.drawio.figures import INVISIBLE, figures_of, page_from_figure
from pilotage.io.drawio.floorplan import Style, is_furniture
from pilotage.io.drawio.labels import lines_of, read_label
from pilotage.io.pages import choose_page, other_pages
from pilotage.io.sheet_builder import SheetBuilder, outline_through

UP = (1.0, -1.0)
"""Turns y down into y up."""


def read_drawio(path: Path, page: str | None = None) -> Sheet:
    """Read a page of a draw.io file, given by its name or its number from 1.

    Raises FileError if the file is missing or damaged, has no such page, or shows no line.
    """
    diagrams = read_diagrams(path)
    names = [diagram.name for diagram in diagrams]
    chosen = choose_page(names, page, path)
    model = read_model(diagrams[chosen], path)
    reader = PageReader(SheetBuilder(path, y_down=True), read_cells(model))
    for cell in reader.cells.cells.values():
        with reader.builder.surviving("damaged shapes"):
            reader.read(cell)
    background = read_color(model.get("background") or "") or WHITE
    return reader.builder.build(background=background, remarks=other_pages(names, chosen, path))


class PageReader:
    """Turns cells into marks and words."""

    def __init__(self, builder: SheetBuilder, cells: Cells) -> None:
        self.builder = builder
        self.cells = cells
        self.groups: dict[str, int] = {}

    def read(self, cell: Cell) -> None:
        """Read one cell, if it is shown."""
        holders = self.cells.ancestors(cell)
        if not cell.kind or not all(holder.shown for holder in (*holders, cell)):
            return
        layers = (holder.value for holder in holders if not holder.kind)
        names = (*layers, *(holder.named for holder in (*holders, cell)))
        groups = tuple(self.group(holder.cell_id) for holder in holders if holder.kind == "vertex")
        if cell.kind == "edge":
            self.read_edge(cell, names, groups)
        else:
            self.read_vertex(cell, names, groups)

    def group(self, cell_id: str) -> int:
        """Return the number of the group that a cell is."""
        if cell_id not in self.groups:
            self.groups[cell_id] = self.builder.new_group()
        return self.groups[cell_id]

    def read_vertex(self, cell: Cell, names: tuple[str, ...], groups: tuple[int, ...]) -> None:
        """Read a shape and its label."""
        box, style = self.cells.box(cell), cell.style
        shape = style.get("shape", "")
        library = shape if "." in shape or shape == "dimension" else ""
        names = (
            *names,
            "furnishings" if is_furniture(shape) else "",
            library,
            thing_called(" ".join(lines_of(cell.value))),
        )
        if shape == "image" or "image" in style:
            self.builder.leave_out("embedded pictures")
        else:
            self.paint(cell, box, names, (*groups, self.group(cell.cell_id)))
        for text in read_label(cell.value, box, style, names, groups):
            self.builder.add_text(text)

    def paint(self, cell: Cell, box: Box, names: tuple[str, ...], groups: tuple[int, ...]) -> None:
        """Add the outlines of a shape."""
        style = cell.style
        plain = style.get("shape", "") in INVISIBLE
        line, fill = colors_of(style, BLACK if not plain else None, WHITE if not plain else None)
        pen = None if line is None else pen_of(style, line)
        place = page_from_figure(box, style)
        for figure in figures_of(box, style):
            self.builder.add_mark(
                [outline_through((place @ points) * UP, closed=figure.closed) for points in figure.outlines],
                pen=pen,
                fill=fill if figure.filled else None,
                names=names,
                groups=groups,
                source=f"{style.get('shape', 'rectangle')} {cell.cell_id}",
            )

    def read_edge(self, cell: Cell, names: tuple[str, ...], groups: tuple[int, ...]) -> None:
        """Read a line and its label."""
        way = edge_way(cell, self.cells)
        if len(way) < 2:
            return
        heads = (cell.style.get("startArrow", "none"), cell.style.get("endArrow", "classic"))
        names = (*names, "" if heads == ("none", "none") else "arrow")
        line, _ = colors_of(cell.style, BLACK, None)
        self.builder.add_mark(
            [outline_through(way * UP)],
            pen=None if line is None else pen_of(cell.style, line),
            names=names,
            groups=groups,
            source=f"line {cell.cell_id}",
        )
        x, y = way.mean(axis=0)
        for text in read_label(cell.value, Box(float(x), float(y)), cell.style, names, groups):
            self.builder.add_text(text)


def colors_of(style: Style, line: Color | None, fill: Color | None) -> tuple[Color | None, Color | None]:
    """Return the colors of line and area, those given where the style names none."""
    opacity = number(style.get("opacity", ""), 100.0) / 100.0
    stroke = style.get("strokeColor", "default")
    area = style.get("fillColor", "default")
    area = stroke if area == "strokeColor" else area
    if area == "default":
        filled = line if style.get("fillColor") == "strokeColor" else fill
    else:
        filled = read_color(area, opacity * number(style.get("fillOpacity", ""), 100.0) / 100.0)
    if stroke == "default":
        return line, filled
    return read_color(stroke, opacity * number(style.get("strokeOpacity", ""), 100.0) / 100.0), filled


def pen_of(style: Style, line: Color) -> Pen:
    """Return the pen of a style."""
    return Pen(line, max(number(style.get("strokeWidth", ""), 1.0), 0.0), style.get("dashed") == "1")
