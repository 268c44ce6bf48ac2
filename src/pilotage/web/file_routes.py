"""Routes for files: drawings in the folder, examples, uploads and worlds, and what is understood of them."""

import asyncio
from collections.abc import AsyncIterator, Coroutine
from importlib.metadata import version
from pathlib import PurePosixPath
from typing import Any, TypeVar

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from pilotage.web import work
from pilotage.web.folder import RECORDINGS, WORLDS, ChangedError
from pilotage.web.order import OrderError, Place, Sent, numbers
from pilotage.web.table import table_of
from pilotage.worlds import ALL, PackedWorld

Result = TypeVar("Result")

LARGEST_DRAWING = 16 << 20
"""Bytes of a drawing; one with an embedded photo is large."""
LARGEST_UPLOAD = 64 << 20
"""Bytes of an upload."""
UNDERSTAND_WITHIN = 20.0
"""Time [s] to understand a drawing."""
READ_WITHIN = 60.0
"""Time [s] to read an upload: tracing a photo takes a while."""
NOBODY_WAITS = 499
"""Status of an answer that nobody gets."""

MEDIA = {".svg": "image/svg+xml", ".excalidraw": "application/vnd.excalidraw+json"}
"""Media types of drawings."""
UPLOADS = (
    ".svg", ".svgz", ".excalidraw", ".drawio", ".dxf", ".pdf", ".geojson", ".json", ".osm",
    ".png", ".jpg", ".jpeg", ".webp", ".bmp", ".gif", ".tif", ".tiff", ".pgm",
)  # fmt: skip
"""Kinds of files that may be dropped on the page; the reader of a kind says whether a file will do."""

EXAMPLES = {f"{packed.name}/{hand}": (packed, hand) for packed in ALL for hand in ("careful", "quick")}
"""Drawings of the packed worlds, by name."""
ROBOT = "robot"
"""Id of the robot on the network among the worlds."""


def describe_server(request: Request) -> Response:
    """Say what this server is."""
    limits = {"drawing": LARGEST_DRAWING, "upload": LARGEST_UPLOAD}
    return JSONResponse(
        {
            "v": 1,
            "version": version("pilotage"),
            "folder": table_of(request).folder.root.resolve().name,
            "uploads": list(UPLOADS),
            "recordings": list(RECORDINGS),
            "limits": limits,
        }
    )


def list_drawings(request: Request) -> Response:
    """List the drawings in the folder."""
    folder = table_of(request).folder
    listed = []
    for name in folder.names():
        facts = folder.path(name).stat()
        listed.append({"name": name, "bytes": facts.st_size, "modified": facts.st_mtime})
    return JSONResponse({"drawings": listed})


def send_drawing(request: Request) -> Response:
    """Send a drawing and its tag."""
    name = request.path_params["name"]
    content, tag = table_of(request).folder.read(name)
    return Response(content, media_type=media_of(name), headers={"ETag": f'"{tag}"'})


async def save_drawing(request: Request) -> Response:
    """Save a drawing over the version that the page knows, or as a new file."""
    replaces = request.headers.get("if-match")
    is_new = request.headers.get("if-none-match") == "*"
    if (replaces is None) == (not is_new):
        raise HTTPException(
            428, "say which version is replaced with If-Match, or If-None-Match: * for a new file"
        )
    content = await body_of(request, LARGEST_DRAWING)
    name = request.path_params["name"]
    tag = None if replaces is None else replaces.removeprefix("W/").strip('"')
    try:
        written = table_of(request).folder.write(name, content, tag)
    except ChangedError as error:
        why = "the file was changed elsewhere" if error.tag else "the file is no longer there"
        why = "a file of this name is already there" if is_new else why
        return JSONResponse({"error": why, "tag": error.tag}, 409)
    return JSONResponse({"name": name, "tag": written}, 201 if is_new else 200, {"ETag": f'"{written}"'})


def list_examples(_request: Request) -> Response:
    """List the drawings of the packed worlds."""
    listed = [{"name": name, "title": f"{packed.name}, {hand}"} for name, (packed, hand) in EXAMPLES.items()]
    return JSONResponse({"examples": listed})


def send_example(request: Request) -> Response:
    """Send the drawing of a packed world."""
    found = EXAMPLES.get(request.path_params["name"])
    if found is None:
        raise HTTPException(404, "there is no such example")
    return Response(example_drawing(*found).content, media_type=MEDIA[".svg"])


def example_drawing(packed: PackedWorld, hand: str) -> Sent:
    """Read the drawing of a packed world."""
    return Sent(".svg", (packed.careful if hand == "careful" else packed.quick).read_bytes())


def list_worlds(request: Request) -> Response:
    """List worlds to drive in."""
    packed = [
        {
            "id": f"packed:{one.name}",
            "title": one.name,
            "drawings": [name for name, (whose, _) in EXAMPLES.items() if whose is one],
        }
        for one in ALL
    ]
    files = [
        {"id": f"file:{name}", "title": name, "drawings": []}
        for name in table_of(request).folder.names(WORLDS)
    ]
    robot = {"id": ROBOT, "title": "the robot on the network", "drawings": []}
    return JSONResponse({"worlds": ([robot] if table_of(request).robot else []) + packed + files})


def list_recordings(request: Request) -> Response:
    """List logs and journals that can be watched on a drawing."""
    return JSONResponse({"recordings": table_of(request).recordings.list()})


async def send_recording(request: Request) -> Response:
    """Keep a log or a journal that was dropped on the page, to be watched as long as the server runs."""
    content = await body_of(request, LARGEST_UPLOAD)
    keep = table_of(request).recordings.keep
    return JSONResponse(await asyncio.to_thread(keep, request.query_params.get("name", ""), content), 201)


async def understand(request: Request) -> Response:
    """Say what is understood of a drawing; a page that asks again need not wait for the answer."""
    media = request.headers.get("content-type", "").partition(";")[0].strip()
    suffix = next((suffix for suffix, known in MEDIA.items() if known == media), None)
    if suffix is None:
        raise HTTPException(415, f"a drawing must come as {' or '.join(MEDIA.values())}")
    sent = Sent(suffix, await body_of(request, LARGEST_DRAWING), hints_of(request))
    told = [place_in_query(request, name) for name in ("from", "to")]
    ends = None if told[0] is None or told[1] is None else (told[0], told[1])
    table = table_of(request)
    job = table.jobs.run(
        work.understand,
        sent,
        ends,
        table.settings,
        within=UNDERSTAND_WITHIN,
        name="understanding this drawing",
    )
    return JSONResponse(await while_wanted(request, job))


async def while_wanted(request: Request, job: Coroutine[Any, Any, Result]) -> Result:
    """Return what a job returns; a job whose page has gone on is ended, and the next need not wait."""
    working = asyncio.ensure_future(job)
    leaving = asyncio.ensure_future(request.receive())  # the body was read: what comes is the end
    try:
        await asyncio.wait({working, leaving}, return_when=asyncio.FIRST_COMPLETED)
        if working.done():
            return working.result()
        raise HTTPException(NOBODY_WAITS, "nobody waits for this answer any more")
    finally:
        leaving.cancel()
        working.cancel()


def place_in_query(request: Request, name: str) -> Place | None:
    """Read `x,y` or the name of a room."""
    words = request.query_params.get(name)
    if not words:
        return None
    try:
        x, y = numbers([float(part) for part in words.split(",")], name, (2,))
    except (OrderError, ValueError):
        return words
    return x, y


async def upload(request: Request) -> Response:
    """Read a file that was dropped on the page, and make a drawing of it; nothing is stored."""
    name = PurePosixPath(request.query_params.get("name", ""))
    if name.suffix.lower() not in UPLOADS:
        raise HTTPException(
            415, f"a file to upload must be one of {' '.join(UPLOADS)}, got {name.name[:60]!r}"
        )
    sent = Sent(name.suffix.lower(), await body_of(request, LARGEST_UPLOAD), hints_of(request))
    table = table_of(request)
    found = await table.jobs.run(work.read_upload, sent, within=READ_WITHIN, name="reading this file")
    return JSONResponse({"name": table.folder.free_name(name.stem), **found})


def hints_of(request: Request) -> bytes:
    """Read the table beside the drawing of the folder that a request names, if it names one."""
    name = request.query_params.get("drawing")
    return table_of(request).folder.hints(name) if name else b""


async def body_of(request: Request, largest: int) -> bytes:
    """Read a body up to a size."""
    parts: list[bytes] = []
    size = 0
    stream: AsyncIterator[bytes] = request.stream()
    async for part in stream:
        size += len(part)
        if size > largest:
            raise HTTPException(413, f"a file must be smaller than {largest >> 20} MB")
        parts.append(part)
    if size == 0:
        raise HTTPException(400, "the body must be a file, it is empty")
    return b"".join(parts)


def media_of(name: str) -> str:
    """Return the media type of a drawing."""
    return MEDIA[PurePosixPath(name).suffix.lower()]
