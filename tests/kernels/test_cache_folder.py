"""Kernels compile wherever they are installed, and are loaded only when one is used."""

import os
import subprocess
import sys
from pathlib import Path

import numba
import pytest

from pilotage.kernels import cache_folder
from pilotage.kernels.compiling import njit

READ_ONLY = """
import tempfile

plain = tempfile.TemporaryFile

def guarded(*args, dir=None, **more):
    if "__pycache__" in str(dir):
        raise PermissionError(dir)
    return plain(*args, dir=dir, **more)

tempfile.TemporaryFile = guarded  # numba tries whether a folder is writable by this function, and so do we
"""
SAMPLE = """
import numpy as np
from pilotage import kernels

sample = kernels.segment_sampling.sample_segments
print(len(sample(np.array([[0.0, 0.0, 1.0, 0.0]]), 0.5)[0]), sample._cache.cache_path)
"""


def run(code, **variables):
    done = subprocess.run(  # noqa: S603  # our own interpreter
        [sys.executable, "-c", code],
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_importing_the_package_and_its_kernels_does_not_load_numba():
    run("import sys, pilotage, pilotage.maps, pilotage.scan_matching; assert 'numba' not in sys.modules")


@pytest.mark.slow
def test_a_read_only_installation_without_a_home_compiles_in_a_folder_that_goes_away(tmp_path):
    nowhere = {"HOME": "/dev/null", "XDG_CACHE_HOME": "/dev/null/x", "NUMBA_CACHE_DIR": "/dev/null/y"}
    count, folder = run(READ_ONLY + SAMPLE, TMPDIR=str(tmp_path), **nowhere).split()

    assert count == "2"
    assert Path(folder).is_relative_to(tmp_path)
    assert [] == list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_folder_that_the_user_names_is_used(tmp_path):
    _, folder = run(READ_ONLY + SAMPLE, NUMBA_CACHE_DIR=str(tmp_path)).split()

    assert Path(folder).is_relative_to(tmp_path)
    assert any(tmp_path.rglob("*.nbc"))


def test_an_installation_that_is_writable_keeps_its_cache_beside_the_code(monkeypatch):
    monkeypatch.setattr(cache_folder, "is_writable", lambda folder: folder.name == "__pycache__")
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    cache_folder.ensure_cache_folder()

    assert "NUMBA_CACHE_DIR" not in os.environ


@pytest.mark.parametrize("place", ["/dev/null/x", "/proc/x"])
def test_a_folder_that_cannot_be_made_is_not_writable(place):
    assert not cache_folder.is_writable(Path(place))


def test_code_compiles_where_there_is_no_place_for_a_cache(monkeypatch):
    plain = numba.njit

    def without_place(*functions, cache=False):
        if cache:
            raise RuntimeError("cannot cache function 'double': no locator available")
        return plain(*functions) if functions else plain

    def refuse(**_):
        raise FileNotFoundError("No usable temporary directory found")

    monkeypatch.setattr(numba, "njit", without_place)
    monkeypatch.setattr(cache_folder, "is_writable", lambda _: False)
    monkeypatch.setattr(cache_folder.tempfile, "mkdtemp", refuse)
    cache_folder.ensure_cache_folder()

    assert njit(cache=True)(lambda x: 2 * x)(21) == 42
