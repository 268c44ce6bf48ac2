import asyncio
from typing import Any

import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from pilotage.web.guard import Access, Guard
from web_table import LIVE, TOKEN, finished


def test_nobody_gets_in_without_the_token(stranger: TestClient) -> None:
    for path in ("/", "/api/drawings", "/api/openapi.json", "/index.html"):
        assert 401 == stranger.get(path).status_code
    assert 401 == stranger.get("/?token=guess").status_code
    assert 401 == stranger.get("/api/drawings", headers={"Authorization": "Bearer guess"}).status_code


def test_the_printed_address_becomes_a_cookie_and_leaves_the_address_bar(stranger: TestClient) -> None:
    welcome = stranger.get(f"/?token={TOKEN}")

    assert (303, "/") == (welcome.status_code, welcome.headers["location"])
    assert "HttpOnly" in welcome.headers["set-cookie"]
    assert "samesite=strict" in welcome.headers["set-cookie"].lower()
    assert 200 == stranger.get("/").status_code


def test_another_host_is_a_rebound_address(client: TestClient) -> None:
    for host in ("evil.example", "evil.example:8765", "127.0.0.1:80", ""):
        assert 403 == client.get("/api/drawings", headers={"Host": host}).status_code


def test_a_page_from_elsewhere_is_refused(client: TestClient) -> None:
    for origin in ("http://evil.example", "null", "http://127.0.0.1:9999"):
        assert 403 == client.get("/api/drawings", headers={"Origin": origin}).status_code
    assert 200 == client.get("/api/drawings", headers={"Origin": "http://127.0.0.1:8765"}).status_code


@pytest.mark.parametrize(
    "headers", [{}, {"Authorization": f"Bearer {TOKEN}", "Origin": "http://evil.example"}]
)
def test_a_websocket_needs_token_and_origin_too(stranger: TestClient, headers: dict[str, str]) -> None:
    with pytest.raises(WebSocketDisconnect), stranger.websocket_connect(LIVE, headers=headers):
        pass


def test_the_page_may_load_nothing_from_elsewhere(client: TestClient) -> None:
    policy = client.get("/").headers["content-security-policy"]

    assert "default-src 'none'" in policy
    assert "script-src 'self'" in policy
    assert "http" not in policy
    assert "nosniff" == client.get("/assets/page.js").headers["x-content-type-options"]


@pytest.mark.parametrize("header", ["Host", "Origin"])
def test_a_header_that_is_no_address_is_refused(client: TestClient, header: str) -> None:
    assert 403 == client.get("/api/drawings", headers={header: "http://[::1"}).status_code


def test_the_usual_port_of_http_may_be_left_out_of_the_host() -> None:
    assert Access(TOKEN, frozenset({"127.0.0.1:80"})).allows_host("127.0.0.1")
    assert not Access(TOKEN, frozenset({"127.0.0.1:8765"})).allows_host("127.0.0.1")


@pytest.mark.parametrize(("begun", "told"), [([], [503]), ([200], [200])])
def test_a_request_that_the_end_of_the_server_cuts_off_is_no_traceback(
    begun: list[int], told: list[int]
) -> None:
    sent: list[dict[str, Any]] = []

    async def hang(_scope: object, _receive: object, send: Any) -> None:
        for status in begun:
            await send({"type": "http.response.start", "status": status, "headers": []})
        await asyncio.sleep(60.0)

    async def send(message: Any) -> None:
        sent.append(message)

    async def ask() -> None:
        headers = [(b"host", b"here:80"), (b"authorization", f"Bearer {TOKEN}".encode())]
        scope = {
            "type": "http",
            "method": "GET",
            "path": "/api/info",
            "query_string": b"",
            "headers": headers,
        }
        guard = Guard(hang, Access(TOKEN, frozenset({"here:80"})))
        request = asyncio.ensure_future(guard(scope, lambda: asyncio.sleep(60.0), send))
        await asyncio.sleep(0.01)
        request.cancel()
        await request

    finished(ask())

    assert told == [one["status"] for one in sent if "status" in one]
