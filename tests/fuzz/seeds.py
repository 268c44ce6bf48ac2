"""A small valid file of each format that is read, to be spoilt."""

import functools
import gzip
import io
import json
import zipfile

import numpy as np

HALL = [(0, 0), (150, 0), (150, 50), (0, 50), (0, 0)]
WALLS = (HALL, [(50, 0), (50, 20)], [(50, 30), (50, 50)], [(100, 0), (100, 20)], [(100, 30), (100, 50)])

SVG = """<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
 width="150mm" height="50mm" viewBox="0 0 150 50">
<style>.w { stroke: #000; stroke-width: 2 } g > .x { fill: none }</style>
<defs><g id="door"><path d="M0 0 A10 10 0 0 1 10 10 L0 10 Z"/></g></defs>
<g class="w x" transform="translate(1 2) scale(1.5) rotate(5)"><polyline points="0,0 150,0 150,50 0,50 0,0"/>
<path d="M50 0v20m0 10V50" fill="none"/><path d="M100 0 C101 5 99 10 100 20 Q100 30 100 50"/></g>
<use xlink:href="#door" x="50" y="20"/><rect id="goal" x="120" y="20" width="4" height="4" rx="1"/>
<circle class="start" cx="20" cy="30" r="2"/><ellipse cx="70" cy="20" rx="4" ry="2"/>
<text x="20" y="20" font-size="5">off<tspan dy="6">ice</tspan></text>
<flowRoot font-size="4"><flowRegion><rect x="80" y="20" width="20" height="9"/></flowRegion>
<flowPara>hall</flowPara></flowRoot>
<clipPath id="cut"><rect width="65" height="40"/></clipPath>
<g class="furniture" clip-path="url(#cut)"><polygon points="60,10 70,10 70,15"/></g></svg>"""

WORLD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 15 5"><g fill="none" stroke="black">
<rect width="15" height="5"/><line class="door" data-closed="10-40" x1="5" y1="0" x2="5" y2="1"/>
<line class="glass" x1="9" y1="1" x2="9" y2="4"/><polyline class="person" points="1,2 4,2 4,4"/>
<circle id="start" cx="2" cy="2" r=".1"/></g></svg>"""

DRAWIO = """<mxfile><diagram name="Ground"><mxGraphModel dx="1" dy="1"><root>
<mxCell id="0"/><mxCell id="1" parent="0"/>
<mxCell id="2" value="Kitchen" style="rounded=0;html=1;fillColor=none;" vertex="1" parent="1">
<mxGeometry x="0" y="0" width="100" height="80" as="geometry"/></mxCell>
<mxCell id="3" style="shape=mxgraph.floorplan.wall;rotation=90;" vertex="1" parent="1">
<mxGeometry x="100" y="0" width="100" height="8" as="geometry"/></mxCell>
<mxCell id="4" style="endArrow=none;" edge="1" parent="1"><mxGeometry as="geometry">
<mxPoint x="0" y="90" as="sourcePoint"/><mxPoint x="90" y="90" as="targetPoint"/></mxGeometry></mxCell>
</root></mxGraphModel></diagram></mxfile>"""

OSM = """<osm version="0.6"><node id="1" lat="50.0" lon="8.0"/><node id="2" lat="50.0" lon="8.001"/>
<node id="3" lat="50.0005" lon="8.001"><tag k="door" v="yes"/></node><node id="4" lat="50.0005" lon="8.0"/>
<way id="9"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/><tag k="indoor" v="room"/>
<tag k="level" v="0"/><tag k="name" v="Hall"/></way></osm>"""

YAML_MAP = """image: plan.png
resolution: 0.05
origin: [0.0, -1.0, 0.0]
occupied_thresh: 0.65
free_thresh: 0.196
negate: 0
mode: trinary
"""

SETTINGS = """[localizer]
step = 0.5
[localizer.tracks]
min_count = 1000
[navigator]
time_limit = 100.0
[simulator.laser]
beams = 181
"""

HINTS = """page = 2
shading = "lines"
[layers]
A-FURN = "ignore"
[labels]
kitchen = [120, 80.5]
WC = [[40, 20], [200, 20]]
"""

ESTIMATES = """{"stamp": 0.5, "scale": 20.0, "x": 1, "hypotheses": [{"cell": "c1", "probability": 0.9}]}
{"stamp": 1.0, "scale": 20.5, "x": 1, "hypotheses": [{"cell": "c2", "probability": 0.8}]}
"""

CONTENT = b"""0 0 0 rg 0 0 0 RG 2 w 10 10 150 50 re S 60 10 m 60 30 l S 60 40 m 60 60 l S
q 1 0 0 1 5 5 cm 0.5 g 100 20 10 10 re f Q BT /F1 8 Tf 20 30 Td (Kitchen) Tj ET
80 5 m 83 5 l 83 6 l 80 6 l 86 5 m 89 5 l 89 6 l 86 6 l
92 5 m 95 5 l 95 6 l 92 6 l 98 5 m 101 5 l 101 6 l 98 6 l f
1 0 0 1 0 0 cm 3 4 5 6 7 8 c S"""

FONT = b"<< /Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >> >>"


@functools.cache
def seeds() -> dict[str, bytes]:
    """Return the name of each valid file, and its content; the suffix tells the format."""
    return {
        "a.svg": SVG.encode(),
        "a.svgz": gzip.compress(SVG.encode(), mtime=0),
        "a.dxf": dxf(),
        "a.pdf": pdf(),
        "a.excalidraw": excalidraw().encode(),
        "a.drawio": DRAWIO.encode(),
        "a.geojson": geojson().encode(),
        "a.zip": imdf(),
        "a.osm": OSM.encode(),
        "a.png": picture("PNG"),
        "a.jpg": picture("JPEG"),
        "a.pgm": b"P2 6 4 255\n" + b"0 0 0 0 0 0\n0 255 255 0 255 0\n" * 2,
        "map.yaml": YAML_MAP.encode(),
        "world.svg": WORLD.encode(),
        "world.yaml": YAML_MAP.encode(),
        "run.log": log().encode(),
        "run.log.gz": gzip.compress(log().encode(), mtime=0),
        "settings.toml": SETTINGS.encode(),
        "a.svg.toml": HINTS.encode(),
        "estimates.jsonl": ESTIMATES.encode(),
    }


def dxf() -> bytes:
    """Write lines, a door block, a hatched triangle and words, as an old program does."""
    pairs: list[tuple[int, object]] = [
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$INSUNITS"),
        (70, 4),
        (0, "ENDSEC"),
    ]
    pairs += [(0, "SECTION"), (2, "BLOCKS"), (0, "BLOCK"), (8, 0), (2, "DOOR"), (70, 0), (10, 0), (20, 0)]
    pairs += [(0, "ARC"), (8, "A-DOOR"), (10, 0), (20, 0), (40, 9.0), (50, 0), (51, 90)]
    pairs += [(0, "LINE"), (8, "A-DOOR"), (10, 0), (20, 0), (11, 0), (21, 9), (0, "ENDBLK"), (0, "ENDSEC")]
    pairs += [(0, "SECTION"), (2, "ENTITIES")]
    for wall in WALLS:
        pairs += [(0, "POLYLINE"), (8, "A-WALL"), (66, 1), (70, 0)]
        for x, y in wall:
            pairs += [(0, "VERTEX"), (8, "A-WALL"), (10, x), (20, y), (42, 0.1)]
        pairs += [(0, "SEQEND")]
    pairs += [(0, "INSERT"), (8, 0), (2, "DOOR"), (10, 50), (20, 20), (41, 1), (42, 1), (50, 45)]
    pairs += [
        (0, "SOLID"),
        (8, "A-WALL"),
        (10, 0),
        (20, 0),
        (11, 5),
        (21, 0),
        (12, 5),
        (22, 5),
        (13, 5),
        (23, 5),
    ]
    pairs += [(0, "CIRCLE"), (8, "A-FURN"), (10, 20), (20, 20), (40, 3)]
    pairs += [(0, "TEXT"), (8, "A-TEXT"), (10, 20), (20, 30), (40, 4), (1, "Kitchen")]
    pairs += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:3}\n{value}\n" for code, value in pairs).encode()


def pdf() -> bytes:
    """Write a page with lines, an area and a word."""
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 200 100] /Contents 4 0 R /Resources " + FONT + b" >>",
        b"<< /Length %d >>\nstream\n%s\nendstream" % (len(CONTENT), CONTENT),
    ]
    content, places = b"%PDF-1.4\n", []
    for number, body in enumerate(objects, start=1):
        places.append(len(content))
        content += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    table = b"".join(b"%010d 00000 n \n" % place for place in places)
    return (
        content
        + b"xref\n0 5\n0000000000 65535 f \n"
        + table
        + b"trailer << /Size 5 /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % len(content)
    )


def excalidraw() -> str:
    """Write a line, a box, a stroke of a pen and a word."""
    common = {"x": 0, "y": 0, "angle": 0, "strokeColor": "#000", "groupIds": [], "isDeleted": False}
    lines = [{**common, "type": "line", "id": f"l{k}", "points": wall} for k, wall in enumerate(WALLS)]
    box = {**common, "type": "rectangle", "id": "b", "width": 20, "height": 10, "backgroundColor": "#eee"}
    pen = {**common, "type": "freedraw", "id": "p", "points": [[0, 0], [5, 1], [9, 0]]}
    text = {**common, "type": "text", "id": "t", "text": "Hall", "width": 20, "height": 9, "fontSize": 9}
    return json.dumps({"type": "excalidraw", "version": 2, "elements": [*lines, box, pen, text]})


def geojson() -> str:
    """Write a room and an opening."""
    ring = [[8.0, 50.0], [8.001, 50.0], [8.001, 50.0005], [8.0, 50.0005], [8.0, 50.0]]
    room = {
        "type": "Feature",
        "properties": {"category": "room", "name": {"en": "Hall"}, "level": "0"},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    opening = {
        "type": "Feature",
        "properties": {"category": "opening", "level": "0"},
        "geometry": {"type": "LineString", "coordinates": [ring[1], [8.001, 50.0001]]},
    }
    return json.dumps({"type": "FeatureCollection", "features": [room, opening]})


def imdf() -> bytes:
    """Pack units and levels."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name in ("unit", "opening", "level"):
            archive.writestr(zipfile.ZipInfo(f"{name}.geojson"), geojson())
    return stream.getvalue()


def picture(kind: str) -> bytes:
    """Draw the walls with a pen of three pixels."""
    from PIL import Image, ImageDraw

    image = Image.new("RGB", (170, 70), "white")
    pen = ImageDraw.Draw(image)
    for wall in WALLS:
        pen.line([(x + 10, y + 10) for x, y in wall], fill="black", width=3)
    return encoded(np.asarray(image), kind)


def encoded(pixels: np.ndarray, kind: str = "PNG") -> bytes:
    """Write pixels as a picture."""
    from PIL import Image

    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, kind)
    return stream.getvalue()


def log() -> str:
    """Write a few scans with odometry."""
    ranges = " ".join(["2.5"] * 180)
    return "\n".join(f"FLASER 180 {ranges} {0.1 * k} 0 0 {0.1 * k} 0 0 {k} host {k}" for k in range(4))
