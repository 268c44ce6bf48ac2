"""Read spoilt files for a while, and keep those that break a promise: `python -m tests.fuzz --minutes 60`."""

import argparse
import hashlib
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, seed, settings
from tests.fuzz.seeds import seeds
from tests.fuzz.spoiling import spoilt_files
from tests.fuzz.worker import Verdict, Worker

ROUND = 200
"""So many files are drawn from one seed."""


def fuzz(first_seed: int, seconds: float, keep: Path | None = None) -> list[Verdict]:
    """Read spoilt files for so long; return all verdicts. Files that break a promise are kept in a folder."""
    verdicts: list[Verdict] = []
    until = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as name, Worker() as worker:
        folder = Path(name)
        (folder / "plan.png").write_bytes(seeds()["a.png"])  # that of map.yaml and world.yaml
        number = first_seed
        while time.monotonic() < until:
            for verdict, content in one_round(number, folder, worker, until):
                verdicts.append(verdict)
                if verdict.is_bad and keep is not None:
                    keep.mkdir(parents=True, exist_ok=True)
                    digest = hashlib.sha256(content).hexdigest()[:8]
                    (keep / f"{digest}-{verdict.name}").write_bytes(content)
            number += 1
    return verdicts


def one_round(number: int, folder: Path, worker: Worker, until: float) -> list[tuple[Verdict, bytes]]:
    """Read the files of one seed."""
    found: list[tuple[Verdict, bytes]] = []

    @seed(number)
    @settings(
        max_examples=ROUND,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(spoilt_files())
    def read(spoilt: tuple[str, bytes]) -> None:
        if time.monotonic() >= until:
            return
        name, content = spoilt
        path = folder / name
        path.write_bytes(content)
        found.append((worker.read(path), content))
        path.unlink()

    read()
    return found


def main() -> None:
    """Read what the command line asks for, and print what broke a promise."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--keep", type=Path, default=Path("build/fuzz"), help="where bad files are kept")
    arguments = parser.parse_args()
    verdicts = fuzz(arguments.seed, 60.0 * arguments.minutes, arguments.keep)
    bad = [verdict for verdict in verdicts if verdict.is_bad]
    for verdict, count in Counter((one.name, one.outcome, one.detail) for one in bad).most_common():
        print(f"{count:5} {verdict[0]:14} {verdict[1]}: {verdict[2]}")
    outcomes = Counter(verdict.outcome for verdict in verdicts)
    told = ", ".join(f"{count} {outcome}" for outcome, count in outcomes.most_common())
    slowest = max((verdict.seconds for verdict in verdicts), default=0.0)
    largest = max((verdict.mb for verdict in verdicts), default=0.0)
    print(
        f"{len(verdicts)} files from seed {arguments.seed}: {told};"
        f" at most {slowest:.1f} s and {largest:.0f} MB"
    )
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
