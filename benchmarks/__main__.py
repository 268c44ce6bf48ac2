"""Run a benchmark: `python -m benchmarks NAME [options]`; `--help` lists all.

The figures of a run with default options are kept in `benchmarks/results/NAME.json`; other runs are kept only
with `--save`. `all` runs all of them, in processes or on a cluster. `readme` writes the tables of README's
section *Measured* from these files. `fetch` checks the data of others that benchmarks read.
"""

import argparse
import contextlib
import json
import os
import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType

os.environ.setdefault("OMP_NUM_THREADS", "1")

from benchmarks.lib import results
from benchmarks.lib.data import DATA
from pilotage.io.files import write_text

NAMES = (
    "localization",
    "staying",
    "calibration",
    "kidnap",
    "mismatch",
    "which",
    "ladder",
    "looks",
    "people",
    "tracking",
    "corrected",
    "corrected_map",
    "navigation",
    "registration",
    "odometry",
    "segmentation",
    "cells",
    "plans",
    "plan_drives",
    "logs",
    "ros",
    "mpeg7",
    "shape",
    "simulation",
    "soak",
    "table",
    "worlds_from_logs",
)
WITHOUT_DATA = ("corrected_map", "logs", "ros", "shape", "simulation", "soak", "table")
TOOLS = ("all", "readme", "fetch")
BESIDE = {
    "json",
    "save",
    "no_save",
    "jobs",
    "journal",
    "figure",
}  # options that leave the figures as they are
TO_STDOUT = Path("-")


def main() -> None:
    """Run what the command line names."""
    words = sys.argv[1:]
    if not words or words[0] in {"-h", "--help"}:
        print(overview())
    elif words[0] in TOOLS:
        import_module(f"benchmarks.{words[0]}").main(words[1:])
    elif words[0] in NAMES:
        run(words[0], words[1:])
    else:
        sys.exit(f"there is no benchmark {words[0]}; known are {', '.join((*NAMES, *TOOLS))}")


def overview() -> str:
    """Describe all benchmarks, a sentence each."""
    lines = [f"  {name:18s}{sentence_of(import_module(f'benchmarks.{name}'))}" for name in (*NAMES, *TOOLS)]
    return "\n".join([*(__doc__ or "").splitlines(), *lines])


def sentence_of(module: ModuleType) -> str:
    """Return the first line of a module's docstring."""
    return (module.__doc__ or "").splitlines()[0]


def run(name: str, words: list[str]) -> None:
    """Run one benchmark and keep its figures."""
    module = import_module(f"benchmarks.{name}")
    parser = parser_of(module, name)
    arguments = parser.parse_args(words)
    if name not in WITHOUT_DATA and not DATA.is_dir():
        parser.error(f"there is no data folder {DATA}; set PILOTAGE_DATA to where it is")
    quiet = arguments.json == TO_STDOUT
    with contextlib.redirect_stdout(sys.stderr) if quiet else contextlib.nullcontext():
        figures = module.measure(arguments)
    keep(name, words, arguments, figures, is_default=is_default(parser, arguments))
    if failure := figures.get("failed"):
        sys.exit(f"{name} failed: {failure}")


def parser_of(module: ModuleType, name: str) -> argparse.ArgumentParser:
    """Build the parser of a benchmark: its own options and those that all have."""
    parser = argparse.ArgumentParser(
        prog=f"python -m benchmarks {name}",
        description=module.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    module.add_arguments(parser)
    parser.add_argument(
        "--json",
        type=Path,
        nargs="?",
        const=TO_STDOUT,
        help="write the figures to this file, or print them alone",
    )
    saving = parser.add_mutually_exclusive_group()
    saving.add_argument(
        "--save", action="store_true", help="keep the figures of a run with other options, too"
    )
    saving.add_argument("--no-save", action="store_true", help="do not keep the figures")
    return parser


def accepts_jobs(name: str) -> bool:
    """Tell whether the number of processes of a benchmark can be chosen."""
    return "jobs" in vars(parser_of(import_module(f"benchmarks.{name}"), name).parse_args([]))


def is_default(parser: argparse.ArgumentParser, arguments: argparse.Namespace) -> bool:
    """Tell whether all options that decide about the figures are as by default."""
    defaults = vars(parser.parse_args([]))
    return all(value == defaults[name] for name, value in vars(arguments).items() if name not in BESIDE)


def keep(
    name: str, words: list[str], arguments: argparse.Namespace, figures: results.Figures, *, is_default: bool
) -> None:
    """Write the figures where they are wanted."""
    if arguments.json == TO_STDOUT:
        print(json.dumps(figures, indent=1))
    elif arguments.json:
        write_text(arguments.json, json.dumps(figures, indent=1) + "\n")
    if arguments.no_save or not figures or "failed" in figures:
        return
    if is_default or arguments.save:
        told = [word for word in words if word not in {"--save", "--json"} and word != str(arguments.json)]
        path = results.save(results.measured(name, told, figures))
        print(f"kept in {path}", file=sys.stderr)
    else:
        print("not kept: options differ from the defaults (--save keeps them)", file=sys.stderr)


if __name__ == "__main__":
    main()
