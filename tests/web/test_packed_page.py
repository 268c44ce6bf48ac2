"""The page that is packed comes from the sources, and is small."""

import hashlib
import io
import zipfile
from pathlib import Path

import pytest

import pilotage

STATIC = Path(pilotage.__file__).with_name("web") / "static"
FRONTEND = Path(__file__).resolve().parents[2] / "frontend"

SINGLE = ("hash-sources.mjs", "index.html", "package.json", "tsconfig.json", "vite.config.mjs")
"""Sources beside those in `src`, as `hash-sources.mjs` lists them."""

LARGEST = 2.5e6
"""Bytes of the zipped page."""


@pytest.mark.skipif(not FRONTEND.is_dir(), reason="the sources of the page are not here")
def test_the_packed_page_is_built_from_the_sources() -> None:
    names = [
        *SINGLE,
        *(str(path.relative_to(FRONTEND)) for path in (FRONTEND / "src").rglob("*") if path.is_file()),
    ]
    digest = hashlib.sha256()
    for name in sorted(names):
        digest.update(f"{name}\0".encode())
        digest.update((FRONTEND / name).read_bytes())

    assert digest.hexdigest() == (STATIC / "sources.sha256").read_text().strip(), "run `make page`"


def test_the_packed_page_is_small() -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in STATIC.rglob("*"):
            archive.write(path)

    assert len(packed.getvalue()) <= LARGEST


def test_the_packed_page_names_no_other_server() -> None:
    page = (STATIC / "index.html").read_text()

    assert "http://" not in page
    assert "https://" not in page


def test_the_licences_of_all_that_is_packed_are_packed() -> None:
    licences = (STATIC / "assets" / "licences.txt").read_text()

    assert "@excalidraw/excalidraw 0.18.0: MIT" in licences
    assert "react-dom" in licences
