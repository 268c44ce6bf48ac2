"""The server's routes together, and what it answers when something is refused."""

import asyncio
import contextlib
from collections.abc import AsyncIterator, Callable
from pathlib import Path

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles

from pilotage.errors import PilotageError
from pilotage.web import file_routes as files
from pilotage.web import live_routes as lives
from pilotage.web.folder import NameRefusedError
from pilotage.web.guard import Access, Guard
from pilotage.web.openapi import document
from pilotage.web.sessions import EXPORTS
from pilotage.web.table import Table
from pilotage.web.workers import RefusedError, WorkerError, warm_up

STATIC = Path(__file__).with_name("static")
"""The packed page, built from `frontend/`."""
TIDY_EVERY = 60.0
"""Time [s] between two looks for drives that nobody watches."""


def build_app(table: Table, access: Access, static: Path = STATIC) -> Starlette:
    """Make the application."""

    @contextlib.asynccontextmanager
    async def lifespan(_app: Starlette) -> AsyncIterator[None]:
        await asyncio.to_thread(warm_up)
        tidying = asyncio.create_task(tidy(table))
        try:
            yield
        finally:
            tidying.cancel()
            table.close()

    app = Starlette(
        routes=routes(static),
        middleware=[Middleware(Guard, access=access)],
        exception_handlers=HANDLERS,
        lifespan=lifespan,
    )
    app.state.table = table
    return app


def routes(static: Path) -> list[Route | WebSocketRoute | Mount]:
    """List the routes; the protocol is in docs/reference/table-api.md."""

    def page(_request: Request) -> Response:
        if not (static / "index.html").is_file():
            raise HTTPException(404, "the page is not packed; `make page` builds it")
        return FileResponse(static / "index.html")

    return [
        Route("/", page),
        Route("/api/openapi.json", lambda _request: JSONResponse(document())),
        Route("/api/info", files.describe_server),
        Route("/api/drawings", files.list_drawings),
        Route("/api/drawings/{name:path}", files.send_drawing),
        Route("/api/drawings/{name:path}", files.save_drawing, methods=["PUT"]),
        Route("/api/examples", files.list_examples),
        Route("/api/examples/{name:path}", files.send_example),
        Route("/api/uploads", files.upload, methods=["POST"]),
        Route("/api/understand", files.understand, methods=["POST"]),
        Route("/api/worlds", files.list_worlds),
        Route("/api/recordings", files.list_recordings),
        Route("/api/recordings", files.send_recording, methods=["POST"]),
        Route("/api/sessions", lives.list_sessions),
        Route("/api/sessions/{number}", lives.forget_session, methods=["DELETE"]),
        *(Route(f"/api/sessions/{{number}}/{kind}", lives.export_of(kind)) for kind in EXPORTS),
        WebSocketRoute("/api/live", lives.live),
        Mount("/", StaticFiles(directory=static, check_dir=False)),
    ]


async def tidy(table: Table) -> None:
    """Forget drives that nobody watches."""
    while True:
        await asyncio.sleep(TIDY_EVERY)
        table.sessions.forget_unwatched()


def refuse(status: int) -> Callable[[Request, Exception], Response]:
    """Answer an error with its own words."""

    def answer(_request: Request, error: Exception) -> Response:
        return JSONResponse({"error": str(error)}, status)

    return answer


def refuse_http(_request: Request, error: Exception) -> Response:
    """Answer an error that knows its status."""
    assert isinstance(error, HTTPException)
    return JSONResponse({"error": error.detail}, error.status_code, error.headers)


def refuse_missing(_request: Request, _error: Exception) -> Response:
    """Answer that a file is not there."""
    return JSONResponse({"error": "there is no such file"}, 404)


def refuse_file(_request: Request, error: Exception) -> Response:
    """Answer that what has the name of a drawing is a folder, or may not be touched."""
    assert isinstance(error, OSError)
    return JSONResponse({"error": f"this cannot be read or written ({error.strerror})"}, 409)


HANDLERS = {
    HTTPException: refuse_http,
    FileNotFoundError: refuse_missing,
    IsADirectoryError: refuse_file,
    NotADirectoryError: refuse_file,
    PermissionError: refuse_file,
    NameRefusedError: refuse(400),
    RefusedError: refuse(422),
    PilotageError: refuse(422),
    WorkerError: refuse(504),
}
"""How errors are answered."""
