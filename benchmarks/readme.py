"""Write the tables of README's section *Measured* from the results that are kept.

    python -m benchmarks readme

The text between `<!-- measured: NAME -->` and `<!-- end -->` is replaced. Below each table stand the command,
the commit and the date of its run; a table of other code than most of the latest day is marked. What was
never measured has no place there.
"""

import argparse
import re
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from benchmarks.lib import results
from benchmarks.lib.data import ROOT
from benchmarks.lib.results import Measurement
from pilotage.io.files import write_text

README = ROOT / "README.md"
BLOCK = re.compile(r"<!-- measured: (\w+) -->\n(.*?)<!-- end -->", re.DOTALL)


class NotMeasuredError(Exception):
    """A table is asked for of which there are no results."""


def main(words: Sequence[str]) -> None:
    """Rewrite README, or check it."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks readme",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--check", action="store_true", help="change nothing; fail if README differs")
    arguments = parser.parse_args(words)
    old = README.read_text()
    try:
        new = rewritten(old)
    except NotMeasuredError as error:
        sys.exit(str(error))
    if arguments.check and new != old:
        sys.exit("README differs from the results: run python -m benchmarks readme")
    if new != old:
        write_text(README, new)


def rewritten(text: str, folder: Path = results.FOLDER) -> str:
    """Replace the text of all blocks by what their results say; raises NotMeasuredError if one has none."""
    found = {name: measurement_of(name, folder) for name in names_in(text)}
    latest = latest_commit(list(found.values()))

    def block(match: re.Match[str]) -> str:
        name = match[1]
        return f"<!-- measured: {name} -->\n{body(name, found[name], latest)}\n<!-- end -->"

    return BLOCK.sub(block, text)


def names_in(text: str) -> list[str]:
    """Name the benchmarks whose tables a text shows."""
    return [match[1] for match in BLOCK.finditer(text)]


def measurement_of(name: str, folder: Path) -> Measurement:
    """Read the last measurement of a benchmark; raises NotMeasuredError if there is none."""
    found = results.load(name, folder)
    if found is None:
        raise NotMeasuredError(f"README shows {name}, which was never measured: python -m benchmarks {name}")
    return found


def latest_commit(measurements: Sequence[Measurement]) -> str:
    """Return the commit of the latest measurement; of those of one day, the commit that most have."""
    if not measurements:
        return ""
    date = max(one.date for one in measurements)
    commits = [one.commit for one in measurements if one.date == date]
    return max(commits, key=commits.count)


def body(name: str, measurement: Measurement, latest: str) -> str:
    """Write one block."""
    rendered = import_module(f"benchmarks.{name}").render(measurement.figures)
    return f"{rendered}\n\n{origin(measurement, latest)}"


def origin(measurement: Measurement, latest: str) -> str:
    """Tell where figures come from, and mark those of other code than the latest."""
    machine = measurement.machine
    mark = "" if measurement.commit == latest else f" **Other code than most tables ({latest}).**"
    return (
        f"*`{measurement.command}`, commit {measurement.commit}, {measurement.date}, {machine['cpu']},"
        f" {machine['cores']} cores, Python {machine['python']}.*{mark}"
    )
