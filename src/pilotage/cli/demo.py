"""`pilotage demo`: the whole journey on what is packed with the package."""

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.run import draw, estimates_sink, open_localizer, read_stretch, run
from pilotage.cli.terminal import say
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.geometry import Array
    from pilotage.localization import Estimate
    from pilotage.maps import SchematicMap
    from pilotage.perception import Reading

MARK = ".pilotage-demo"
"""A folder with this file in it was made by the demo, and may be made anew."""


def demo(
    *,
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results.")] = Path("demo"),
    seed: Annotated[int, typer.Option(min=0, help="Seed of all that is left to chance.")] = 0,
    force: Annotated[bool, typer.Option("--force", help="Replace files that the demo did not make.")] = False,
) -> None:
    """Find a simulated robot in a drawing made from a poor memory.

    The robot drives through an office floor full of furniture with a laser and bad odometry. The drawing has
    no scale, wrong proportions and no furniture, and nobody says where the drive begins. Leaves
    *where.png* and *estimates.jsonl* in the folder.

    **Example:** `pilotage demo -o demo`
    """
    estimates_path, figure_path = output / "estimates.jsonl", output / "where.png"
    claim(output, [estimates_path, figure_path], force=force)
    from pilotage import demo as packed
    from pilotage.io import open_map

    sketch = open_map(packed.SKETCH)
    readings = read_stretch(packed.LOG, 0, None)
    localizer = open_localizer(sketch, None, seed, None, None)
    with estimates_sink(estimates_path, sketch) as write:
        estimates = run(localizer, readings, write)
    truth = read_truth(packed.TRUTH, sketch)
    draw(sketch, localizer, estimates, figure_path, title="A robot found in a drawing", truth=truth)
    typer.echo(story(estimates, readings, truth, sketch))
    say(f"See {figure_path} and {estimates_path}.")


def claim(folder: Path, files: Sequence[Path], *, force: bool) -> None:
    """Make the folder our own; refuse to replace files in a folder that is not."""
    mark = folder / MARK
    if not mark.exists() and not force:
        for path in files:
            if path.exists():
                raise FileError(
                    "a file is already there that the demo did not make, --force replaces it", path
                )
    try:
        folder.mkdir(parents=True, exist_ok=True)
        mark.touch()
    except OSError as error:
        raise FileError(f"the folder cannot be made ({error.strerror})", folder) from error


def read_truth(path: Path, sketch: "SchematicMap") -> "Array":
    """Read where the robot truly was at each scan, in the sketch frame, (n, 2) [drawing units]."""
    import numpy as np

    records = [json.loads(line) for line in path.read_text().splitlines()]
    return sketch.sketch_from_file(np.array([(record["x"], record["y"]) for record in records]))


def story(
    estimates: "Sequence[Estimate]", readings: "Sequence[Reading]", truth: "Array", sketch: "SchematicMap"
) -> str:
    """Say in plain words what happened, and whether it is true."""
    import numpy as np

    from pilotage.localization import Status

    odometry = np.array([reading.odometry.odom_from_base.position for reading in readings])
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(odometry, axis=0).T))])
    positions = np.array([estimate.sketch_from_base.pose.position for estimate in estimates])
    scales = np.array([estimate.sketch_from_base.scale for estimate in estimates])
    errors = np.hypot(*(positions - truth).T) / scales
    located = np.array([estimate.status is Status.LOCATED for estimate in estimates])
    drive = f"The robot drove {way[-1]:.0f} m and took {len(readings)} scans."
    if not located.any():
        return f"{drive} It never found its place in the drawing."
    first = int(np.argmax(located))
    name = nearest_label(positions[-1], sketch)
    end = (
        f'At the end it says that it is in {estimates[-1].cell_id}, near the word "{name}", '
        f"with confidence {estimates[-1].confidence:.2f}; that is {errors[-1]:.1f} m from where it truly is."
        if located[-1]
        else "At the end it is lost."
    )
    return (
        f"{drive} After {way[first]:.0f} m it claimed a place, and held one for {located.mean():.0%} of the "
        f"scans: half of these places are within {np.median(errors[located]):.1f} m of the true one. {end}"
    )


def nearest_label(position: "Array", sketch: "SchematicMap") -> str:
    """Find the word of the drawing that stands nearest."""
    return min(
        sketch.labels, key=lambda label: math.dist(label.position, (float(position[0]), float(position[1])))
    ).text
