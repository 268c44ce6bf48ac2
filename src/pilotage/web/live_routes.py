"""Routes for drives: the websocket by which one is started, watched and changed, and its records."""

import asyncio
import contextlib
import json
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import Any

from starlette.background import BackgroundTask
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from pilotage.web import order as orders
from pilotage.web.file_routes import EXAMPLES, LARGEST_DRAWING, MEDIA, ROBOT, example_drawing
from pilotage.web.folder import WORLDS
from pilotage.web.order import MadeRealOrder, Order, OrderError, RecordingOrder, RobotOrder, Sent
from pilotage.web.sessions import Client, Session
from pilotage.web.table import Table, table_of
from pilotage.web.workers import WorkerError
from pilotage.worlds import ALL

Message = dict[str, Any]

PASSED_ON = (
    *("pause", "step", "speed", "goal", "kidnap", "door", "box", "person", "stop"),
    *("drive", "place", "alive"),
)
"""Messages that are for the worker of the drive."""
LARGEST_MESSAGE = 2 * LARGEST_DRAWING
"""Letters of a message: a drawing that is not saved comes in one."""
UNUSABLE = 1003
"""Code with which a websocket is closed whose first message is no use (RFC 6455)."""
BROKEN = 1006
"""Code of a websocket that ended without a word."""


async def live(websocket: WebSocket) -> None:
    """Talk to a page about one drive."""
    await websocket.accept()
    try:
        session = await first_message(websocket)
    except WebSocketDisconnect:
        return
    if session is None:
        with contextlib.suppress(WebSocketDisconnect):  # the page has gone before
            await websocket.close(UNUSABLE)
        return
    client = Client()
    session.join(client)
    sending = asyncio.create_task(send_all(websocket, client))
    try:
        while True:
            await obey(await receive(websocket), session, client)
    except WebSocketDisconnect:
        pass
    finally:
        session.leave(client)
        sending.cancel()
        with contextlib.suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):
            await sending


async def first_message(websocket: WebSocket) -> Session | None:
    """Start a drive or go back to one; None, and an error, if the page asks for neither."""
    message = await receive(websocket)
    try:
        return await find_session(message, table_of(websocket))
    except (ValueError, WorkerError, OSError) as error:
        await websocket.send_text(error_text(error, fatal=True))
        return None


async def find_session(message: Message, table: Table) -> Session:
    """Start a drive, go back to one, or start it anew; OrderError or what `read_order` and `begin` raise."""
    if message.get("type") == "start":
        return await table.sessions.begin(read_order(message, table))
    if message.get("type") not in ("resume", "restart"):
        raise OrderError("the first message must be start, resume or restart")
    session = table.sessions.get(orders.text(message, "session"))
    if session is None:
        raise OrderError("this drive is no longer there")
    if message["type"] == "restart":
        speed = orders.number(message, "speed", *orders.SPEEDS, otherwise=session.order.speed)
        return await table.sessions.begin(replace(session.order, speed=speed))
    session.resume()
    return session


async def receive(websocket: WebSocket) -> Message:
    """Receive a message; one that is none is answered, and the next one is waited for.

    Raises WebSocketDisconnect if nobody is there any more, also if that was noticed by what was sent.
    """
    while True:
        received = await websocket.receive()
        if received["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(received["code"])
        try:
            message = json.loads(received.get("text") or "")
        except (ValueError, RecursionError):
            message = None
        if isinstance(message, dict):
            return message
        if websocket.application_state is not WebSocketState.CONNECTED:
            raise WebSocketDisconnect(BROKEN)
        await websocket.send_text(error_text(OrderError("a message must be a JSON object")))


async def send_all(websocket: WebSocket, client: Client) -> None:
    """Send what waits for a client, as fast as it takes it."""
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while True:
            for text in await client.take():
                await websocket.send_text(text)


async def obey(message: Message, session: Session, client: Client) -> None:
    """Do what a page asks."""
    kind = message.get("type")
    if kind in PASSED_ON:
        refusal = session.refusal(kind, client)
        if refusal:
            client.put("error", error_text(OrderError(refusal)))
        else:
            await asyncio.to_thread(session.tell, message)
    elif kind == "leave":
        if not session.is_watched_beside(client):
            await asyncio.to_thread(session.tell, {"type": "stop"})
    elif kind == "seen":
        client.saw()
    elif kind == "scrub":
        try:
            t = message.get("t")
            moment = None if t is None else orders.number(message, "t", 0.0, orders.FARTHEST)
        except OrderError as error:
            client.put("error", error_text(error))
            return
        if not session.seeks:
            session.scrub(client, moment)
        elif moment is not None:
            await asyncio.to_thread(session.tell, {"type": "seek", "t": moment})


def error_text(error: Exception, *, fatal: bool = False) -> str:
    """Write a message that says what will not do."""
    return json.dumps({"v": 1, "type": "error", "text": str(error), "fatal": fatal})


def read_order(message: Message, table: Table) -> Order:
    """Read what the page orders; OrderError, OSError or NameRefusedError if it will not do."""
    drawing, title, example = read_drawing(message, table)
    world, packed = read_world(message, table)
    warp = None
    if example is not None and packed is EXAMPLES[example][0]:
        warp = packed.folder / f"{EXAMPLES[example][1]}.json"
    goal, start = message.get("goal"), message.get("start")
    return Order(
        title=title,
        drawing=drawing,
        world=world,
        warp=warp,
        goal=None if goal is None else orders.place(goal, "goal"),
        start=None if start is None else orders.numbers(start, "start", (2, 3)),
        seed=orders.whole(message, "seed"),
        speed=orders.number(message, "speed", *orders.SPEEDS, otherwise=1.0),
        paused=orders.switch(message, "paused", otherwise=False),
        settings=table.settings,
    )


def read_drawing(message: Message, table: Table) -> tuple[Sent, str, str | None]:
    """Find the drawing of a drive, its title, and which example it is, if it is one."""
    content = message.get("content")
    if isinstance(content, dict):
        media, words = content.get("media"), content.get("text")
        suffix = next((suffix for suffix, known in MEDIA.items() if known == media), None)
        if suffix is None or not isinstance(words, str) or len(words) > LARGEST_DRAWING:
            raise OrderError(f"content must hold media ({' or '.join(MEDIA.values())}) and text")
        title = message.get("title")
        saved = message.get("drawing")
        hints = table.folder.hints(orders.text(message, "drawing")) if saved is not None else b""
        return (
            Sent(suffix, words.encode(), hints),
            title[:80] if isinstance(title, str) else "a drawing",
            None,
        )
    name = orders.text(message, "drawing")
    kind, _, example = name.partition(":")
    if kind == "example":
        if example not in EXAMPLES:
            raise OrderError(f"there is no example {example[:60]!r}")
        return example_drawing(*EXAMPLES[example]), example, example
    try:
        content, _ = table.folder.read(name)
        return Sent(PurePosixPath(name).suffix.lower(), content, table.folder.hints(name)), name, None
    except FileNotFoundError as error:
        raise OrderError(f"there is no drawing {name!r}") from error


def read_world(
    message: Message, table: Table
) -> tuple[Path | MadeRealOrder | RecordingOrder | RobotOrder, Any]:
    """Find the world of a drive, and which packed one it is, if it is one; or a recording instead."""
    if message.get("recording") is not None:
        path, title = table.recordings.find(orders.text(message, "recording"))
        world = None if message.get("world") is None else find_world(orders.text(message, "world"), table)[0]
        return RecordingOrder(path, title, world), None
    made_real = message.get("made_real")
    if isinstance(made_real, dict):
        severity = orders.number(made_real, "severity", 0.0, 1.0, otherwise=0.5)
        return MadeRealOrder(severity, orders.whole(made_real, "seed")), None
    if message.get("world") == ROBOT:
        if table.robot is None:
            raise OrderError("there is no robot on the network: the table was not started with --ros2")
        return table.robot, None
    return find_world(orders.text(message, "world"), table)


def find_world(wanted: str, table: Table) -> tuple[Path, Any]:
    """Find a world, and which packed one it is, if it is one."""
    kind, _, name = wanted.partition(":")
    for packed in ALL if kind == "packed" else ():
        if packed.name == name:
            return packed.world, packed
    if kind != "file" or name not in table.folder.names(WORLDS):
        raise OrderError(f"there is no world {wanted[:60]!r}")
    return table.folder.path(name, WORLDS), None


def list_sessions(request: Request) -> Response:
    """List the drives."""
    listed = [
        {
            "session": one.number,
            "title": one.title,
            "t": round(one.t, 2),
            "over": one.over,
            "outcome": one.outcome,
        }
        for one in table_of(request).sessions.all()
    ]
    return JSONResponse({"sessions": listed})


def forget_session(request: Request) -> Response:
    """End a drive and forget it."""
    if not table_of(request).sessions.forget(request.path_params["number"]):
        raise HTTPException(404, "this drive is no longer there")
    return Response(status_code=204)


def export_of(kind: str) -> Callable[[Request], Awaitable[Response]]:
    """Make the route that sends the journal, the film or the picture of a drive."""

    async def export(request: Request) -> Response:
        sessions = table_of(request).sessions
        session = sessions.get(request.path_params["number"])
        if session is None:
            raise HTTPException(404, "this drive is no longer there")
        path = await session.export(kind, sessions.folder)
        return FileResponse(path, filename=f"drive{path.suffix}", background=BackgroundTask(path.unlink))

    return export
