"""Zones that a person drew are told by their names, and are no walls."""

import numpy as np
import pytest

from pilotage.io import open_map

ROOM = '<rect x="0" y="0" width="100" height="60"/>'
ZONES = """<rect id="keep-out" x="10" y="10" width="20" height="20"/>
<g class="slow"><polygon points="50,10 70,10 70,30"/></g>
<line id="one-way-2" x1="80" y1="50" x2="95" y2="50"/>"""


def drawn(folder, body):
    path = folder / "room.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" fill="none" stroke="black">{body}</svg>')
    return open_map(path)


def test_zones_are_read_and_close_nothing(tmp_path):
    sketch, plain = drawn(tmp_path, ROOM + ZONES), drawn(tmp_path, ROOM)
    zones = sketch.zones

    assert len(plain.segments) == len(sketch.segments)
    assert zones.are_kept_out(sketch.sketch_from_file(np.array([(20.0, 20.0), (60.0, 15.0)]))).tolist() == [
        True,
        False,
    ]
    assert zones.is_slow(sketch.sketch_from_file(np.array([(65.0, 15.0)]))[0])
    ((first, last),) = (sketch.file_from_sketch(arrow.vertices).tolist() for arrow in zones.one_way)
    assert [80.0, 50.0] == first
    assert [95.0, 50.0] == last
    assert not plain.zones


@pytest.mark.parametrize("name", ["keep_out", "KeepOut", "Sperrzone 3", "no-go area", "layer keep out"])
def test_a_zone_is_known_by_several_names(tmp_path, name):
    body = ROOM + f'<rect class="{name}" id="{name}" x="10" y="10" width="20" height="20"/>'

    assert len(drawn(tmp_path, body).zones.keep_out) == 1
