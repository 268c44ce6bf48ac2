"""`pilotage simplify`: what is left of a drawing once its noise is gone."""

import math
from pathlib import Path
from typing import Annotated

import typer

from pilotage.cli.drawing import Labels, Layers, Map, Page, Shade, open_drawing
from pilotage.cli.options import Force, SettingsFile
from pilotage.cli.terminal import check_outputs, say


def simplify(
    drawing: Map,
    *,
    share: Annotated[
        float | None,
        typer.Option(
            min=0.0,
            help="Vertices less relevant than this share of the drawing's diagonal go.",
            show_default="localizer.atlas.detail of the settings",
        ),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option(help="Where to draw it before and after (.png, .svg, .pdf).")
    ] = None,
    layer: Layers = None,
    label: Labels = None,
    page: Page = None,
    shading: Shade = "recognized",
    settings: SettingsFile = None,
    force: Force = False,
) -> None:
    """Simplify a drawing by discrete curve evolution (Wolter 2001, section 2.2; figure 1).

    The least relevant vertex is deleted again and again; ends stay, and no stroke comes to cross another.

    **Example:** `pilotage simplify office.svg --figure evolution.png`
    """
    check_outputs((), figure=figure, force=force)
    from pilotage.config import read_settings
    from pilotage.shape import Simplification, simplify_all

    if share is None:
        share = read_settings(settings).localizer.atlas.detail
    if not math.isfinite(share):
        raise typer.BadParameter(f"a share must be finite, got {share}", param_hint="--share")
    sketch = open_drawing(drawing, layer, label, page, shading).sketch
    evolved = simplify_all(sketch.strokes, Simplification(share * sketch.diagonal))
    before, after = (sum(len(stroke) for stroke in strokes) for strokes in (sketch.strokes, evolved))
    typer.echo(f"{len(sketch.strokes)} strokes, {before} vertices; after evolution {after}")
    if figure is not None:
        from pilotage.figures.drawing import drawing_figure
        from pilotage.figures.style import save

        save(drawing_figure(sketch, evolved), figure)
        say(f"drawn in {figure}")
