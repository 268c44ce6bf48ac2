"""Check the data of others that benchmarks read, and bring what is missing where an address is known.

    python -m benchmarks fetch

`benchmarks/data.toml` names each file or folder with its origin and its SHA-256. The digest of a folder is
that of the sorted lines `<sha256>  <name>` of its files.
"""

import argparse
import hashlib
import sys
import tomllib
import urllib.request
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.lib.data import DATA, ROOT
from pilotage.io.files import replacing

MANIFEST = ROOT / "benchmarks" / "data.toml"
TIMEOUT = 60.0  # [s]


@dataclass(frozen=True, slots=True)
class Item:
    """A file, or a folder of files that belong together."""

    path: str  # in the data folder
    sha256: str
    origin: str  # where a person finds it
    url: str  # of the very same bytes, empty if there is none


def main(words: Sequence[str]) -> None:
    """Check all, fetch what can be fetched, and fail if anything is missing or different."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks fetch",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="beginnings of paths; all by default")
    parser.add_argument("--check", action="store_true", help="fetch nothing")
    arguments = parser.parse_args(words)
    items = [one for one in read_manifest(MANIFEST) if chosen(one, arguments.names)]
    if not items:
        parser.error(f"nothing in {MANIFEST.name} begins with {' or '.join(arguments.names)}")
    problems = 0
    for item in items:
        told = state(item, DATA)
        if told == "missing" and item.url and not arguments.check:
            told = fetched(item, DATA)
        problems += told not in {"ok", "fetched"}
        print(f"{item.path}: {told}")
    if problems:
        sys.exit(f"{problems} of {len(items)} are not as they should be in {DATA}")


def read_manifest(path: Path) -> tuple[Item, ...]:
    """Read the manifest: groups with an origin, each with its files."""
    groups = tomllib.loads(path.read_text())["group"]
    return tuple(item for group in groups for item in items_of(group))


def items_of(group: dict[str, object]) -> Iterator[Item]:
    """List the files of a group; `url` is a beginning to which the file's name is added."""
    origin, base = str(group["origin"]), str(group.get("url", ""))
    files = group["files"]
    assert isinstance(files, dict)
    for path, digest in files.items():
        yield Item(path, digest, origin, f"{base}{Path(path).name}" if base else "")


def chosen(item: Item, names: Sequence[str]) -> bool:
    """Tell whether an item is asked for."""
    return not names or any(item.path.startswith(name) for name in names)


def state(item: Item, folder: Path) -> str:
    """Tell whether an item is there as it should be."""
    path = folder / item.path
    if not path.exists():
        return "missing" if item.url else f"missing; it comes from {item.origin}"
    found = digest_of(path)
    return "ok" if found == item.sha256 else f"differs: SHA-256 {found}, should be {item.sha256}"


def digest_of(path: Path) -> str:
    """Return the SHA-256 of a file or a folder."""
    if path.is_file():
        return hashlib.sha256(path.read_bytes()).hexdigest()
    lines = [
        f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.relative_to(path).as_posix()}\n"
        for file in sorted(path.rglob("*"))
        if file.is_file()
    ]
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def fetched(item: Item, folder: Path) -> str:
    """Bring an item; nothing is written unless its digest is right."""
    if not item.url.startswith("https://"):
        return f"missing; {item.url} is no https address"
    try:
        with urllib.request.urlopen(item.url, timeout=TIMEOUT) as answer:  # noqa: S310  # https only
            content = answer.read()
    except OSError as error:
        return f"missing; {item.url} cannot be read ({error})"
    found = hashlib.sha256(content).hexdigest()
    if found != item.sha256:
        return f"missing; {item.url} now has other bytes (SHA-256 {found})"
    path = folder / item.path
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as beside:
        beside.write_bytes(content)
    return "fetched"
