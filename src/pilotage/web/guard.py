"""Who may talk to the server: this machine, the page it served itself, and who knows the token."""

import asyncio
import hmac
from collections.abc import Iterable
from dataclasses import dataclass

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self'; worker-src 'self' blob:; "
    "manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""What the page may load: nothing from elsewhere. The drawing editor sets styles from its scripts."""

HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-cache",
}

POLICY_VIOLATION = 1008
"""Code with which a websocket is closed that may not be opened (RFC 6455)."""


@dataclass(frozen=True, slots=True)
class Access:
    """The token, and the names under which this server may be called."""

    token: str
    hosts: frozenset[str]  # with their port, as in a Host header
    any_host: bool = False  # for a server that others on the network may use

    @property
    def cookie(self) -> str:
        """Name of the cookie; cookies of other ports of this machine are seen too, so each has its own."""
        port = min(self.hosts, default="").rpartition(":")[2]
        return f"pilotage-{port}"

    def allows_host(self, host: str) -> bool:
        """Tell whether a request was meant for this server: another name is a rebound address.

        Browsers leave out the port of HTTP, 80.
        """
        return self.any_host or not self.hosts.isdisjoint({host.lower(), f"{host.lower()}:80"})

    def allows_origin(self, origin: str | None, host: str) -> bool:
        """Tell whether a request comes from a page of this server, or from no page at all."""
        return origin is None or origin.lower() in (f"http://{host.lower()}", f"https://{host.lower()}")

    def knows(self, offered: Iterable[str | None]) -> bool:
        """Tell whether one of the offered tokens is the right one."""
        return any(hmac.compare_digest(one.encode(), self.token.encode()) for one in offered if one)


class Guard:
    """Lets requests through that may be answered, and adds headers that keep the page to itself."""

    def __init__(self, app: ASGIApp, access: Access) -> None:
        self.app = app
        self.access = access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request or a websocket, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return

        has_begun = False

        async def send_with_headers(message: Message) -> None:
            nonlocal has_begun
            if message["type"] == "http.response.start":
                has_begun = True
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        refusal = self.refusal(HTTPConnection(scope))
        if refusal is None:
            try:
                await self.app(scope, receive, send_with_headers)
            except asyncio.CancelledError:  # the server ends before the answer is there
                if scope["type"] == "http" and not has_begun:
                    await refused(503, "the drawing table has ended")(scope, receive, send_with_headers)
        elif scope["type"] == "http":
            await refusal(scope, receive, send_with_headers)
        else:
            await receive()
            await send({"type": "websocket.close", "code": POLICY_VIOLATION})

    def refusal(self, asked: HTTPConnection) -> Response | None:
        """Say why a request is not answered; None if it is.

        The address that the command printed is answered by a cookie, so that the token leaves the address.
        """
        access, host = self.access, asked.headers.get("host", "")
        if not access.allows_host(host):
            return refused(403, "this server is asked under a name that is not its own")
        if not access.allows_origin(asked.headers.get("origin"), host):
            return refused(403, "this page belongs to another server")
        if asked.scope["path"].startswith("/assets/"):
            return None  # the scripts of the page are no secret
        if asked.scope["path"] == "/" and access.knows([asked.query_params.get("token")]):
            welcome = RedirectResponse("/", 303)
            welcome.set_cookie(access.cookie, access.token, httponly=True, samesite="strict")
            return welcome
        scheme, _, bearer = asked.headers.get("authorization", "").partition(" ")
        if access.knows([asked.cookies.get(access.cookie), bearer if scheme.lower() == "bearer" else None]):
            return None
        return refused(401, "open the address that `pilotage table` printed, it holds the token")


def refused(status: int, why: str) -> JSONResponse:
    """Answer that a request is refused."""
    return JSONResponse({"error": why}, status)
