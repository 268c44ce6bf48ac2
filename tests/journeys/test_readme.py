"""The Python of README does what it says."""

import gzip
import re
from pathlib import Path

import pytest

from pilotage import worlds

README = Path(__file__).resolve().parents[2] / "README.md"


@pytest.mark.slow
def test_the_python_of_the_readme_runs(tmp_path, capsys):
    (program,) = re.findall(r"```python\n(.*?)```", README.read_text(), flags=re.DOTALL)
    log = tmp_path / "run.log.gz"
    with gzip.open(worlds.LOG, "rt") as whole, gzip.open(log, "wt") as part:
        part.writelines(list(whole)[:8])
    files = {"office.svg": worlds.OFFICE.careful, "run.log.gz": log, "building.yaml": worlds.OFFICE.world}
    for name, path in files.items():
        assert f'"{name}"' in program
        program = program.replace(f'"{name}"', repr(str(path)))
    assert '"kitchen"' in program
    program = program.replace('"kitchen"', repr("Ana"))
    exec(compile(program, str(README), "exec"), {})  # noqa: S102  # our own words
    *told, driven = capsys.readouterr().out.splitlines()

    assert {"lost", "located"} >= {line.split()[0] for line in told}
    assert "is reached" in driven
    assert driven.endswith(" 0")
