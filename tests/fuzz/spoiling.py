"""Strategies for files that are nearly valid."""

import re

import numpy as np
from hypothesis import strategies as st
from tests.fuzz.seeds import encoded, seeds

NASTY = [
    *b"0 -1 1e308 -1e308 1e-308 nan inf -inf 1e5 -1e9 99999999999999999999 0x10 1e 2,5 .5.5 1e400".split(),
    b"9" * 400,  # a whole number that no float can hold
]
"""Numbers that break what is not made for them."""

NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
WORD = re.compile(rb"[A-Za-z_:#-]{2,}")

SHAPES = ("line", "rect", "circle", "ellipse", "polyline", "polygon", "path", "text", "g", "use", "svg")
ATTRIBUTES = (
    "x", "y", "x1", "y1", "x2", "y2", "cx", "cy", "r", "rx", "ry", "width", "height", "points", "d",
    "transform", "viewBox", "style", "class", "id", "stroke", "fill", "stroke-width", "href", "clip-path",
)  # fmt: skip
PIECES = (
    "0", "1", "-5", "50", "1e308", "nan", "50%", "10mm", "M", "L", "A", "C", "Q", "Z", "h", "a", ",", " ",
    "10 10", "rotate(", "scale(0)", "matrix(", ")", "url(#a)", "#a", "red", "none", "goal", "furniture",
)  # fmt: skip


@st.composite
def spoilt_files(draw: st.DrawFn) -> tuple[str, bytes]:
    """Draw a name and a content."""
    known = seeds()
    name = draw(st.sampled_from(sorted(known)))
    kind = draw(st.integers(0, 9))
    if kind == 0 and name.endswith(".svg"):
        return name, draw(made_up_svg())
    if kind <= 1 and name.endswith(".png"):
        return name, draw(made_up_pictures())
    content = known[name]
    for _ in range(draw(st.integers(1, 4))):
        content = draw(spoilt(content))
    return name, content[:1_000_000]


@st.composite
def spoilt(draw: st.DrawFn, content: bytes) -> bytes:
    """Change a content in one way."""
    if not content:
        return content
    at, to = sorted((draw(st.integers(0, len(content))), draw(st.integers(0, len(content)))))
    to = min(to, at + draw(st.sampled_from([1, 20, 500])))
    head, middle, tail = content[:at], content[at:to], content[to:]
    match draw(st.integers(0, 8)):
        case 0:
            spoilt = head
        case 1:
            spoilt = head + tail
        case 2:
            spoilt = head + middle * draw(st.integers(2, 30)) + tail
        case 3:
            other = seeds()[draw(st.sampled_from(sorted(seeds())))]
            spoilt = head + other[at % len(other) :][: to - at] + tail
        case 4:
            spoilt = head + draw(st.binary(min_size=1, max_size=8)) + tail
        case 5:
            spoilt = exchanged(content, WORD, draw(st.integers(0, 999)), draw(st.integers(0, 999)))
        case _:
            number = draw(st.sampled_from(NASTY))
            spoilt = replaced(content, NUMBER, draw(st.integers(0, 999)), number)
    return spoilt


def replaced(content: bytes, pattern: re.Pattern[bytes], which: int, value: bytes) -> bytes:
    """Put a value in the place of one match."""
    found = list(pattern.finditer(content))
    if not found:
        return content
    match = found[which % len(found)]
    return content[: match.start()] + value + content[match.end() :]


def exchanged(content: bytes, pattern: re.Pattern[bytes], which: int, other: int) -> bytes:
    """Put one match in the place of another."""
    found = list(pattern.finditer(content))
    return replaced(content, pattern, which, found[other % len(found)][0]) if found else content


@st.composite
def made_up_svg(draw: st.DrawFn) -> bytes:
    """Nest random shapes with random attributes."""
    values = st.lists(st.sampled_from(PIECES), max_size=6).map(" ".join)
    parts = []
    for _ in range(draw(st.integers(1, 12))):
        shape = draw(st.sampled_from(SHAPES))
        attributes = draw(st.dictionaries(st.sampled_from(ATTRIBUTES), values, max_size=5))
        written = " ".join(f'{key}="{value}"' for key, value in sorted(attributes.items()))
        parts.append(f"<{shape} {written}>{draw(st.sampled_from(['', 'hall']))}</{shape}>")
    return f"<svg>{''.join(parts)}</svg>".encode()


@st.composite
def made_up_pictures(draw: st.DrawFn) -> bytes:
    """Fill a picture with blocks and noise."""
    height, width = draw(st.integers(1, 120)), draw(st.integers(1, 120))
    generator = np.random.default_rng(draw(st.integers(0, 2**32)))
    pixels = np.full((height, width, 3), draw(st.sampled_from([0, 120, 205, 255])), dtype=np.uint8)
    for _ in range(draw(st.integers(0, 8))):
        top, left = generator.integers(height), generator.integers(width)
        pixels[top : top + generator.integers(1, 60), left : left + generator.integers(1, 60)] = (
            generator.integers(0, 256, 3)
        )
    if draw(st.booleans()):
        noise = generator.random((height, width)) < 0.2
        pixels[noise] = generator.integers(0, 256, (int(noise.sum()), 3))
    return encoded(pixels)
