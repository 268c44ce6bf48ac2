"""Small files that would take very long or very much memory."""

import gzip
import struct
import zlib
from collections.abc import Callable

ZEROS = 600_000_000
"""Bytes that a packed file unpacks to."""

PART = 10_000_000
"""Bytes of it that are packed once, however often they are repeated."""


def use_bomb(width: int, depth: int) -> bytes:
    """Use a group in a group, again and again."""
    groups = ['<g id="a0"><line x2="9" stroke="red"/></g>']
    for level in range(1, depth + 1):
        uses = f'<use href="#a{level - 1}"/>' * width
        groups += [f'<g id="a{level}">{uses}</g>']
    return f"<svg>{''.join(groups)}</svg>".encode()


def css_bomb(words: int, depth: int) -> bytes:
    """Ask for a chain of descendants that fits in very many ways, and then does not."""
    rule = f"q {'g ' * words} rect {{ stroke: red }}"
    body = f"{'<g>' * depth}<rect width='9' height='9'/>{'</g>' * depth}"
    return f"<svg><style>{rule}</style>{body}</svg>".encode()


def laughs() -> bytes:
    """Define entities by entities."""
    lines = ['<!ENTITY a0 "ha">']
    lines += [f'<!ENTITY a{k} "{f"&a{k - 1};" * 10}">' for k in range(1, 10)]
    return f"<!DOCTYPE svg [{''.join(lines)}]><svg><text>&a9;</text></svg>".encode()


def packed_zeros(head: bytes) -> bytes:
    """Pack zeros behind a head, in parts that follow each other as gzip allows."""
    first, other = (gzip.compress(start + bytes(PART), 1, mtime=0) for start in (head, b""))
    return first + other * (ZEROS // PART - 1)


def png_header(width: int, height: int) -> bytes:
    """Begin a gray picture of this size that holds nothing else."""

    def chunk(name: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    rows = zlib.compress(b"\0" * min(height * (width + 1), 20_000_000), 1)
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


BOMBS: dict[str, Callable[[], bytes]] = {
    "use-tenfold.svg": lambda: use_bomb(10, 6),
    "use-twofold.svg": lambda: use_bomb(2, 18),
    "use-itself.svg": lambda: b'<svg><g id="a"><use href="#a"/></g><use href="#a"/></svg>',
    "css-descendants.svg": lambda: css_bomb(10, 24),
    "css-braces.svg": lambda: b"<svg><style>" + b"a" * 40_000 + b"</style><line x2='9'/></svg>",
    "nested.svg": lambda: b"<svg>" + b"<g>" * 100_000 + b"</g>" * 100_000 + b"</svg>",
    "many-lines.svg": lambda: b"<svg>" + b'<line x2="5" y2="3" stroke="red"/>' * 500_000 + b"</svg>",
    "long-path.svg": lambda: b'<svg><path stroke="red" d="M0 0' + b" L5 5 L9 0" * 400_000 + b'"/></svg>',
    "laughs.svg": laughs,
    "zeros.svgz": lambda: packed_zeros(b"<svg>"),
    "run-zeros.log.gz": lambda: packed_zeros(b"FLASER "),
    "wide.png": lambda: png_header(50_000, 50_000),
    "large.png": lambda: png_header(4_400, 4_400),
    "long.png": lambda: png_header(2**31 - 1, 1),
    "settings-dots.toml": lambda: b"a." * 20_000 + b"a = 1",
    "settings-brackets.toml": lambda: b"a = " + b"[" * 50_000,
    "deep.excalidraw": lambda: (
        b'{"type": "excalidraw", "elements": ' + b"[" * 100_000 + b"]" * 100_000 + b"}"
    ),
    "deep.geojson": lambda: (
        b'{"type": "FeatureCollection", "features": ' + b"[" * 100_000 + b"]" * 100_000 + b"}"
    ),
    "deep.drawio": lambda: b"<mxfile>" + b"<a>" * 100_000 + b"</a>" * 100_000 + b"</mxfile>",
    "world-far.yaml": lambda: b"image: plan.png\nresolution: 5000\norigin: [0, 0, 0]\n",
    "world-absurd.yaml": lambda: b"image: plan.png\nresolution: 1e308\norigin: [0, 0, 0]\n",
    "world-mm.svg": lambda: b'<svg><rect width="12000" height="8000" stroke="red"/></svg>',
    "huge-numbers.svg": lambda: (
        b'<svg><line x2="1e308" y2="5" stroke="red"/><rect width="9" height="9"/></svg>'
    ),
}
"""The name of each, and what makes its content."""
