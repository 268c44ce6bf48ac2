"""The REST part of the protocol as an OpenAPI document; `docs/reference/table-api.md` says what it means."""

from importlib.metadata import version


def document() -> dict[str, object]:
    """Return the document."""
    return {
        "openapi": "3.1.0",
        "info": {
            "title": "pilotage, the drawing table",
            "version": version("pilotage"),
            "description": "Files and understanding; drives go over the websocket /api/live.",
        },
        "security": [{"token": []}, {"cookie": []}],
        "components": {
            "securitySchemes": {
                "token": {"type": "http", "scheme": "bearer"},
                "cookie": {"type": "apiKey", "in": "cookie", "name": "pilotage-PORT"},
            }
        },
        "paths": {path: dict(operations) for path, operations in PATHS.items()},
    }


def operation(summary: str, *, takes: str = "", status: str = "200", **parameters: str) -> dict[str, object]:
    """Describe one request; parameters are `path`, `query` or `header` by name."""
    described: dict[str, object] = {
        "summary": summary,
        "responses": {
            status: {"description": "as asked"},
            "default": {
                "description": "refused: a sentence says why",
                "content": {
                    "application/json": {
                        "schema": {"type": "object", "properties": {"error": {"type": "string"}}}
                    }
                },
            },
        },
    }
    if parameters:
        described["parameters"] = [
            {
                "name": name.replace("_", "-").strip("-"),
                "in": where,
                "required": where == "path",
                "schema": {"type": "string"},
            }
            for name, where in parameters.items()
        ]
    if takes:
        described["requestBody"] = {"required": True, "content": {kind: {} for kind in takes.split()}}
    return described


DRAWING = "image/svg+xml application/vnd.excalidraw+json"

PATHS: dict[str, dict[str, object]] = {
    "/api/info": {"get": operation("what this server is")},
    "/api/drawings": {"get": operation("list the drawings in the folder")},
    "/api/drawings/{name}": {
        "get": operation("read a drawing; ETag is its version", name="path"),
        "put": operation(
            "save a drawing over a version (If-Match) or as a new file (If-None-Match: *)",
            takes=DRAWING,
            name="path",
            If_Match="header",
            If_None_Match="header",
        ),
    },
    "/api/examples": {"get": operation("list drawings of the packed worlds")},
    "/api/examples/{name}": {"get": operation("read one of them", name="path")},
    "/api/uploads": {
        "post": operation(
            "make a drawing of a file of any kind; nothing is stored",
            takes="application/octet-stream",
            name="query",
            drawing="query",
        )
    },
    "/api/understand": {
        "post": operation(
            "say what is understood of a drawing",
            takes=DRAWING,
            drawing="query",
            **{"from": "query", "to": "query"},
        )
    },
    "/api/worlds": {"get": operation("list worlds to drive in")},
    "/api/recordings": {
        "get": operation("list laser logs and journals that can be watched"),
        "post": operation(
            "keep a log or a journal, to be watched",
            takes="application/octet-stream",
            status="201",
            name="query",
        ),
    },
    "/api/sessions": {"get": operation("list drives")},
    "/api/sessions/{number}": {"delete": operation("end and forget a drive", status="204", number="path")},
    "/api/sessions/{number}/journal": {"get": operation("its journal, JSON Lines", number="path")},
    "/api/sessions/{number}/corrected": {
        "get": operation("the drawing as the robot found it, SVG in metres", number="path")
    },
    "/api/sessions/{number}/film": {"get": operation("its film, GIF", number="path")},
    "/api/sessions/{number}/picture": {"get": operation("its picture, PNG", number="path")},
}
