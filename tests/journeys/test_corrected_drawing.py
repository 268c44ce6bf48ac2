"""From a log to the drawing in metres, by the command line; and on real logs the error is halved."""

import re

import numpy as np
import pytest
from PIL import Image

from few_particles import FEW_AS_TOML
from pilotage import worlds
from pilotage.correction import append_sighting, correct_drawing
from pilotage.evaluation.walls import TrueWalls
from pilotage.evaluation.warp import read_warp
from pilotage.io import open_log, open_map, open_world
from pilotage.localization import Localizer, LocalizerSettings
from pilotage.ranking.evidence import reduced
from shared_data import LOGS, SKETCHES, needs_logs

OFFICE = worlds.OFFICE.folder
FEW = reduced(LocalizerSettings(), 1 / 8)


@pytest.mark.slow
def test_the_packed_log_corrects_the_packed_sketch(pilotage, tmp_path):
    out, settings = tmp_path / "corrected.svg", tmp_path / "few.toml"
    settings.write_text(FEW_AS_TOML)
    words = ("-o", tmp_path / "out.jsonl", "--corrected", out, "--settings", settings, "--explain")

    outcome = pilotage("localize", OFFICE / "quick.svg", worlds.LOG, *words)

    assert 0 == outcome.code
    assert "Corrected: " in outcome.err
    assert re.search(r"walls in view from .*: \d+ seen where", outcome.err)
    left, bottom, right, top = open_world(OFFICE / "world.svg").bounds
    assert open_map(out).diagonal == pytest.approx(np.hypot(right - left, top - bottom), rel=0.15)
    assert open_world(out) is not None


def test_a_corrected_drawing_replaces_nothing_unasked(pilotage, tmp_path):
    picture = tmp_path / "corrected.png"
    Image.new("L", (4, 4)).save(picture)
    before = picture.read_bytes()

    outcome = pilotage(
        "localize", OFFICE / "quick.svg", worlds.LOG, "--corrected", tmp_path / "corrected.yaml"
    )

    assert 1 == outcome.code
    assert "--force replaces it" in outcome.err
    assert before == picture.read_bytes()


def test_nothing_is_written_if_nothing_is_believed(pilotage, tmp_path):
    out = tmp_path / "corrected.svg"

    outcome = pilotage(
        "localize",
        OFFICE / "quick.svg",
        worlds.LOG,
        "--to",
        "3",
        "-o",
        tmp_path / "out.jsonl",
        "--corrected",
        out,
    )

    assert 1 == outcome.code
    assert "no corrected drawing is written: a correction needs" in outcome.err
    assert not out.exists()


@pytest.mark.parametrize(
    "words", [("localize", OFFICE / "quick.svg", worlds.LOG, "--corrected", "metres.dxf")]
)
def test_an_ending_that_says_no_format_is_refused(pilotage, words):
    outcome = pilotage(*words)

    assert 1 == outcome.code
    assert "must end in .svg, .yaml or .yml: metres.dxf" in outcome.err


@needs_logs
@pytest.mark.slow
def test_a_real_log_halves_the_error_of_a_sketch():
    path = SKETCHES / "fhw" / "quick.svg"
    sketch = open_map(path)
    localizer = Localizer(sketch, FEW)
    sightings = []
    for reading in open_log(LOGS / "fhw.log.gz").readings[::3]:
        localizer.update(reading.scan, reading.odometry)
        append_sighting(sightings, localizer, reading.scan)
    warp = read_warp(path.with_suffix(".json"), sketch)
    truth = TrueWalls.of(
        sketch, warp, warp.world_from_sketch(np.vstack([s.vertices for s in sketch.strokes]))
    )

    corrected = correct_drawing(localizer.atlas, sightings)

    places = corrected.metres_from_sketch @ truth.in_sketch
    assert truth.error_of(places) < 0.5 * truth.error_of_drawing()
