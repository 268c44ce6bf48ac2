import time
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from pilotage.web import drawings, file_routes, work
from pilotage.web.order import Sent
from web_table import CLOSED, FLAT

SVG = {"Content-Type": "image/svg+xml"}


def test_two_tabs_do_not_lose_each_others_work(client: TestClient, folder: Path) -> None:
    made = client.put("/api/drawings/flat.svg", content=FLAT, headers={"If-None-Match": "*"})
    tag = made.headers["etag"]
    assert 201 == made.status_code
    assert (
        409 == client.put("/api/drawings/flat.svg", content="x", headers={"If-None-Match": "*"}).status_code
    )

    first = client.put("/api/drawings/flat.svg", content=CLOSED, headers={"If-Match": tag})
    second = client.put("/api/drawings/flat.svg", content="late", headers={"If-Match": tag})

    assert (200, 409) == (first.status_code, second.status_code)
    assert first.json()["tag"] == second.json()["tag"]
    assert CLOSED == (folder / "flat.svg").read_text() == client.get("/api/drawings/flat.svg").text
    assert 428 == client.put("/api/drawings/flat.svg", content="x").status_code


def test_nothing_outside_of_the_folder_is_reached(client: TestClient) -> None:
    for name in (
        "%2e%2e/secret.svg",
        "..%2fsecret.svg",
        "%2Fetc%2Fpasswd",
        "a/%2e%2e/%2e%2e/secret.svg",
        "x%00.svg",
    ):
        assert 400 == client.get(f"/api/drawings/{name}").status_code
        assert (
            400
            == client.put(f"/api/drawings/{name}", content="x", headers={"If-None-Match": "*"}).status_code
        )
    assert 404 == client.get("/assets/%2e%2e/%2e%2e/secret.svg").status_code
    assert 404 == client.get("/api/drawings/none.svg").status_code


def test_cells_names_gateways_and_a_route_are_understood(client: TestClient) -> None:
    found = client.post("/api/understand?from=kitchen&to=150,90", content=FLAT, headers=SVG).json()

    assert {"kitchen", "office", "hall", "store"} == {cell["name"] for cell in found["cells"]}
    assert 4 == len(found["gateways"])
    assert [30.0, 30.0] == found["goal"]
    assert [150.0, 90.0] == found["route"]["way"][-1]
    assert 3 == len(found["route"]["cells"])
    assert [] == found["findings"]
    assert [10.0, 10.0, 190.0, 110.0] == found["bounds"]


def test_the_table_beside_a_drawing_is_read_as_by_the_commands(client: TestClient, folder: Path) -> None:
    (folder / "plans").mkdir()
    (folder / "plans/flat.svg.toml").write_text('[labels]\nattic = [50, 35]\n[layers]\nshelf = "ignore"\n')
    drawn = FLAT.replace("</svg>", '<path id="shelf" d="M20 10 V60"/></svg>')
    ask = "?name=flat.svg&drawing=plans/flat.svg"

    found = client.post(f"/api/understand{ask}", content=drawn, headers=SVG).json()
    read = client.post(f"/api/uploads{ask}", content=drawn).json()

    assert "attic" in [cell["id"] for cell in found["cells"]]
    assert 4 == len(found["cells"])
    assert "hints are taken from the table beside the drawing" in found["assumed"]
    assert "attic" in [label["text"] for label in read["labels"]]
    assert "kitchen" not in [label["text"] for label in read["labels"]]
    other = client.post("/api/understand?drawing=other.svg", content=drawn, headers=SVG).json()
    assert "attic" not in [label["text"] for label in other["labels"]]
    assert 400 == client.post("/api/understand?drawing=../x.svg", content=drawn, headers=SVG).status_code


def test_a_table_beside_a_drawing_that_cannot_be_read_is_a_finding(client: TestClient, folder: Path) -> None:
    (folder / "flat.svg.toml").write_text("walls = 3\n")

    found = client.post("/api/understand?drawing=flat.svg", content=FLAT, headers=SVG).json()

    assert ["unreadable"] == [one["kind"] for one in found["findings"]]
    assert "a table of hints holds" in found["findings"][0]["text"]


def test_a_room_without_a_door_is_found_and_the_proposed_cut_mends_it(client: TestClient) -> None:
    found = client.post("/api/understand", content=CLOSED, headers=SVG).json()
    (closed,) = [one for one in found["findings"] if one["severity"] == "warning"]
    (x, y1), (_, y2) = closed["mend"]["segment"]
    low, high = sorted((y1, y2))

    mended = CLOSED.replace("M130 10 V110", f"M130 10 V{low} M130 {high} V110")

    assert 130.0 == pytest.approx(x, abs=2.0)
    again = client.post("/api/understand", content=mended, headers=SVG).json()
    assert [] == [one for one in again["findings"] if one["severity"] == "warning"]
    assert 2 == len(again["gateways"])


@pytest.mark.parametrize(
    "content",
    [
        "<svg/>",
        "nonsense",
        "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0 L9 9' stroke='red'/></svg>",
    ],
)
def test_a_drawing_that_shows_nothing_is_no_error_but_a_finding(client: TestClient, content: str) -> None:
    answer = client.post("/api/understand", content=content, headers=SVG)

    assert 200 == answer.status_code
    assert [] == answer.json()["cells"]
    assert ["error"] == [one["severity"] for one in answer.json()["findings"]]
    assert "pilotage-" not in answer.text  # the name of a temporary file


def test_a_drawing_must_say_what_it_is(client: TestClient) -> None:
    assert 415 == client.post("/api/understand", content=FLAT).status_code
    assert 400 == client.post("/api/understand", headers=SVG).status_code


def test_an_upload_becomes_a_drawing_under_a_free_name_and_is_not_stored(
    client: TestClient, folder: Path
) -> None:
    (folder / "flat.svg").touch()
    found = client.post("/api/uploads?name=flat.svg", content=FLAT).json()

    assert "flat-2.svg" == found["name"]
    assert {"kitchen", "office", "hall", "store"} == {label["text"] for label in found["labels"]}
    again = client.post("/api/understand", content=found["svg"], headers=SVG).json()
    assert 4 == len(again["cells"])
    assert [30.0, 30.0] == pytest.approx(again["goal"])
    assert ["flat.svg"] == [path.name for path in folder.iterdir()]


def test_zones_are_understood_and_kept_in_an_upload(client: TestClient) -> None:
    zones = (
        '<rect class="keep-out" x="20" y="20" width="10" height="8"/><path class="one-way" d="M90 35 H110"/>'
        '<circle class="slow" cx="150" cy="90" r="8"/></svg>'
    )
    sent = FLAT.replace("</svg>", zones)
    told = client.post("/api/understand", content=sent, headers=SVG).json()["zones"]
    kept = client.post("/api/uploads?name=zoned.svg", content=sent).json()

    assert [1, 1, 1] == [len(told[kind]) for kind in ("keep-out", "slow", "one-way")]
    assert [[20, 20], [20, 28], [30, 20], [30, 28]] == sorted(told["keep-out"][0])
    assert [[90, 35], [110, 35]] == told["one-way"][0]
    assert (
        told
        == kept["zones"]
        == client.post("/api/understand", content=kept["svg"], headers=SVG).json()["zones"]
    )


@pytest.mark.parametrize(
    ("name", "content", "status"),
    [
        ("tool.exe", b"MZ", 415),
        ("", b"x", 415),
        ("photo.png", b"\x89PNG\r\n\x1a\n" + b"\0" * 100, 422),
        ("plan.svg", b"<!DOCTYPE x [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><svg>&a;</svg>", 422),
        ("bomb.svg", b"\x1f\x8b" + b"\0" * 50, 422),
    ],
)
def test_a_hostile_upload_is_one_sentence(client: TestClient, name: str, content: bytes, status: int) -> None:
    answer = client.post(f"/api/uploads?name={name}", content=content)

    assert status == answer.status_code
    assert "\n" not in answer.json()["error"]
    assert "root:" not in answer.text


def test_an_upload_is_bounded(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(file_routes, "LARGEST_UPLOAD", 1 << 20)

    assert 413 == client.post("/api/uploads?name=a.png", content=b"\0" * (2 << 20)).status_code


def test_a_drawing_that_takes_too_long_is_stopped_and_the_next_is_answered(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(file_routes, "UNDERSTAND_WITHIN", 0.05)
    began = time.monotonic()
    slow = client.post("/api/understand", content=FLAT.replace("</svg>", CIRCLES + "</svg>"), headers=SVG)
    monkeypatch.undo()

    assert 504 == slow.status_code
    assert time.monotonic() - began < 30.0
    assert 200 == client.post("/api/understand", content=FLAT, headers=SVG).status_code
    assert work.understand.__doc__


CIRCLES = "".join(f'<circle cx="{x}" cy="{y}" r="3"/>' for x in range(15, 190, 8) for y in range(15, 110, 8))


def test_examples_and_worlds_are_listed_and_can_be_read(client: TestClient, folder: Path) -> None:
    (folder / "building.yaml").write_text("image: x.pgm")
    names = [one["name"] for one in client.get("/api/examples").json()["examples"]]
    worlds = {one["id"] for one in client.get("/api/worlds").json()["worlds"]}

    assert 6 == len(names)
    assert all("<svg" in client.get(f"/api/examples/{name}").text for name in names)
    assert {"packed:office", "packed:home", "packed:museum", "file:building.yaml"} == worlds
    assert 404 == client.get("/api/examples/none").status_code


def test_every_route_is_in_the_openapi_document(client: TestClient) -> None:
    documented = client.get("/api/openapi.json").json()["paths"]
    served = {route.path.replace(":path", "") for route in client.app.routes}  # type: ignore[attr-defined]

    assert served - {"/", "", "/api/live", "/api/openapi.json"} == set(documented)


THICK = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 220 120">
<path fill="black" fill-rule="evenodd" d="M10 10 H210 V110 H10 Z
M16 16 V104 H107 V70 H113 V104 H204 V16 H113 V50 H107 V16 Z"/></svg>"""
"""Two rooms between walls that have a thickness."""


def test_furniture_stays_furniture_in_an_upload(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    sofa = '<path class="furniture" d="M12 12 h6 v4 h-6 z"/></svg>'
    furnished = FLAT.replace("</svg>", sofa).encode()
    read = client.post("/api/uploads?name=a.svg", content=furnished).json()

    assert [{"points": [[12, 12], [18, 12], [18, 16], [12, 16]], "closed": True}] == read["furniture"]
    monkeypatch.setattr(drawings, "MOST_FURNITURE", 0)
    read = drawings.read_upload(Sent(".svg", furnished))
    assert [] == read["furniture"]
    assert "the furniture is left out: it has 1 lines, more than 0" in read["notes"]


def test_walls_that_have_a_thickness_keep_it_in_an_upload(client: TestClient) -> None:
    drawn = client.post("/api/understand", content=THICK, headers=SVG).json()
    found = client.post("/api/uploads?name=thick.svg", content=THICK).json()

    again = client.post("/api/understand", content=found["svg"], headers=SVG).json()
    assert (2, 1) == (len(drawn["cells"]), len(drawn["gateways"]))
    assert (2, 1) == (len(again["cells"]), len(again["gateways"]))


def test_a_folder_that_is_called_like_a_drawing_is_refused_in_a_sentence(
    client: TestClient, folder: Path
) -> None:
    (folder / "floor.svg").mkdir()
    read = client.get("/api/drawings/floor.svg")
    written = client.put("/api/drawings/floor.svg", content=FLAT, headers={"If-None-Match": "*"})

    assert [409, 409] == [read.status_code, written.status_code]
    assert "Is a directory" in read.json()["error"]


def test_an_upload_with_a_long_name_gets_one_that_a_disk_can_hold(client: TestClient) -> None:
    name = client.post(f"/api/uploads?name={'ü' * 300}.svg", content=FLAT).json()["name"]

    assert name.endswith("ü.svg")
    assert len(name.encode()) < 256
