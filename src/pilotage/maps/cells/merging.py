"""Merge pieces across weak openings until each is what a person would name (Wolter 2001, section 4.1).

An opening separates two cells if it narrows, has depth behind it, or stands between jambs (decision 0010).
"""

import heapq
from collections.abc import Sequence

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.maps.cells.borders import JAMBS, NARROWING, borders_of, region_areas
from pilotage.maps.cells.tessellation import Tessellation

CORRIDOR_END = 1.5
"""Without jambs, both sides are this many times as wide: where two corridors cross, free space is sqrt(2)
times as wide as they are, and more if one is the wider."""

MOUTH, MOUTH_DEPTH = 1.8, 0.3
"""No door, but a mouth: one side is this many times as wide, and the smaller one has this area, in squares
over the opening."""

FEW_DOORS = 1 / 8
"""On an open floor a smaller share of all openings are doors, and of its area closed off. There it is a mouth
if only one side is as much wider as both are at a door."""

JAMBS_NARROWING, JAMBS_DEPTH = 1.1, 0.6
"""A wide door stands between jambs, with a lower narrowing and this area."""

COLUMN, SCREEN = 0.5, 2.5
"""Two openings are one if what parts them is no wider than this share of one or, between lines, stands free
and is no larger than so many times one. What stands free and has a thickness may be a wall."""

ALIGNED = np.cos(np.radians(30.0))
"""Openings lie in a row if their directions differ by no more."""

PILLAR, CROSSING = 0.2, 4
"""A column in a hall is no larger than this share of an opening beside it, and at least so many openings lead
away from it that go on beyond it. A piece of wall between doors is larger."""

WITHIN_WALL = 0.5
"""What lies between two outlines of one wall at a door has at most this area, in squares of its width."""

DIGITS = 3
"""Openings whose separations agree in so many decimals are alike: else rounding errors would decide."""


class Regions:
    """Growing regions of pieces, and the chords that lie between each two."""

    def __init__(
        self,
        tessellation: Tessellation,
        among: NDArray[np.bool_],
        named: NDArray[np.bool_],
        drawn: NDArray[np.bool_],
        min_area: float,
        *,
        mouth: float,
        solids_known: bool,
    ) -> None:
        self.mouth = mouth
        self.least = min_area * float(tessellation.areas[among].sum())
        self.reaches: list[float] = tessellation.reaches.tolist()
        self.areas: list[float] = tessellation.areas.tolist()
        self.widths: list[float] = tessellation.widths.tolist()
        self.jambs: list[float] = tessellation.jambs.tolist()
        self.region_of = np.where(among, np.arange(len(among)), -1)
        self.chords_to: list[dict[int, list[int]]] = [{} for _ in among]
        self.named: list[bool] = named.tolist()
        self.widening: list[float] = tessellation.widening.tolist()
        self.drawn: list[bool] = drawn.tolist()
        self.told: list[bool] = tessellation.told.tolist()
        self.beside = neighbors(tessellation, 0.0 if solids_known else SCREEN)
        self.beyond = beyond_columns(tessellation)
        self.age = [0] * len(among)
        for chord in np.flatnonzero(among[tessellation.sides].all(axis=1)):
            first, second = tessellation.sides[chord].tolist()
            self.chords_to[first].setdefault(second, []).append(int(chord))
            self.chords_to[second].setdefault(first, []).append(int(chord))

    def merged(self) -> NDArray[np.int64]:
        """Merge, the weakest opening first; return the region of each piece, (p,), -1 for the rest (4.1)."""
        queue: list[tuple[float, float, int, int, int]] = []

        def consider(first: int, second: int) -> None:
            strength = self.strength(first, second)
            if strength[0] < 1.0:
                low, high = sorted((first, second))
                heapq.heappush(queue, (*strength, low, high, self.age[low] + self.age[high]))

        for first, others in enumerate(self.chords_to):
            for second in others:
                if first < second:
                    consider(first, second)
        while queue:
            *_, first, second, age = heapq.heappop(queue)
            ages = (self.age[first], self.age[second])
            if min(ages) < 0 or sum(ages) != age:
                continue
            self.absorb(first, second)
            for other in self.chords_to[first]:
                consider(first, other)
        return np.asarray(self.region_of, dtype=np.int64)

    def strength(self, first: int, second: int) -> tuple[float, float]:
        """Tell how much the openings between two regions separate them, and which of equals are weaker (4.1).

        Where the first number is below 1 they are merged. What is too small is merged in any case, first with
        that to which it is most open: what lies before a door goes to the corridor. Only through a door that
        the file tells nothing is merged but the space between two outlines of one wall.
        """
        smaller = min(self.areas[first], self.areas[second])
        chords = self.chords_to[first][second]
        if all(self.told[chord] for chord in chords):
            width = max(self.widths[chord] for chord in chords)
            if smaller > WITHIN_WALL * width**2:
                return np.inf, np.inf
        separation = self.separation(first, second, smaller)
        is_small = smaller < self.least and not (self.named[first] and self.named[second])
        return min(separation, smaller / self.least) if is_small else separation, round(separation, DIGITS)

    def separation(self, first: int, second: int, smaller: float) -> float:
        """Tell how much openings separate two regions, the smaller of this area: the weakest decides."""
        chords = [chord for chord in self.chords_to[first][second] if not self.drawn[chord]]
        reaches = self.reaches[first], self.reaches[second]
        return min(
            (self.separation_at(opening, reaches, smaller) for opening in self.openings(chords)),
            default=np.inf,  # doors are drawn, and nothing else lies between
        )

    def separation_at(self, chords: Sequence[int], reaches: tuple[float, float], smaller: float) -> float:
        """Tell how much one opening separates two regions that are so wide, the smaller of this area."""
        beyond = set[int]().union(*(self.beyond.get(chord, ()) for chord in chords)).difference(chords)
        opening = sum(self.widths[chord] for chord in (*chords, *beyond))
        narrow, wide = sorted(reaches)
        narrowing, mouth, depth = narrow / opening, wide / opening, smaller / opening**2
        jambs = max(self.jambs[chord] * self.widths[chord] for chord in chords) / opening
        has_jambs = max(self.widening[chord] for chord in chords) >= JAMBS
        return max(
            narrowing / (NARROWING if has_jambs else CORRIDOR_END),
            min(mouth / self.mouth, depth / MOUTH_DEPTH),
            min(jambs / JAMBS, narrowing / JAMBS_NARROWING, depth / JAMBS_DEPTH),
        )

    def openings(self, chords: Sequence[int]) -> list[list[int]]:
        """Put chords together that only columns part: each is an opening."""
        left, found = set(chords), []
        while left:
            front, opening = [left.pop()], []
            while front:
                chord = front.pop()
                opening.append(chord)
                beside = self.beside.get(chord, set()) & left
                left -= beside
                front.extend(beside)
            found.append(opening)
        return found

    def absorb(self, first: int, second: int) -> None:
        """Let the first region take in the second."""
        self.region_of[self.region_of == second] = first
        self.reaches[first] = max(self.reaches[first], self.reaches[second])
        self.areas[first] += self.areas[second]
        self.named[first] |= self.named[second]
        for other, chords in self.chords_to[second].items():
            del self.chords_to[other][second]
            if other != first:
                shared = self.chords_to[first].setdefault(other, [])
                shared.extend(chords)
                self.chords_to[other][first] = shared
        self.chords_to[second] = {}
        self.age[first] += 1 + self.age[second]
        self.age[second] = -1


def neighbors(tessellation: Tessellation, screen: float) -> dict[int, set[int]]:
    """Find for each chord the others that no more than a column parts from it, or what stands free.

    What stands free is at most so many times as large as the chord is long.
    """
    lines = shapely.linestrings(tessellation.chords)
    reach = COLUMN * tessellation.widths
    pairs = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=reach).T
    small = tessellation.post_sizes[tessellation.posts] <= screen * tessellation.widths[:, np.newaxis]
    around: dict[int, list[int]] = {}
    for chord, end in np.argwhere(small).tolist():
        around.setdefault(int(tessellation.posts[chord, end]), []).append(chord)
    beside: dict[int, set[int]] = {}
    for chords in [*pairs.tolist(), *around.values()]:
        for chord in chords:
            beside.setdefault(chord, set()).update(chords)
    return beside


def beyond_columns(tessellation: Tessellation) -> dict[int, set[int]]:
    """Find for each chord the others that go on in its direction beyond a column at one of its ends.

    From a column openings lead away to at least four sides: it stands within a hall, and not between rooms.
    """
    steps = tessellation.chords[:, 1] - tessellation.chords[:, 0]
    along = steps / np.maximum(tessellation.widths, 1e-12)[:, np.newaxis]
    at_columns = tessellation.post_sizes[tessellation.posts] <= PILLAR * tessellation.widths[:, np.newaxis]
    around: dict[int, list[int]] = {}
    for chord, end in np.argwhere(at_columns).tolist():
        around.setdefault(int(tessellation.posts[chord, end]), []).append(chord)
    beyond: dict[int, set[int]] = {}
    for chords in around.values():
        aligned = np.abs(along[chords] @ along[chords].T) >= ALIGNED
        np.fill_diagonal(aligned, val=False)
        if np.count_nonzero(aligned.any(axis=1)) >= CROSSING:
            for place, chord in enumerate(chords):
                beyond.setdefault(chord, set()).update(np.array(chords)[aligned[place]].tolist())
    return beyond


def merge_pieces(
    tessellation: Tessellation,
    among: NDArray[np.bool_],
    named: NDArray[np.bool_],
    drawn: NDArray[np.bool_],
    min_area: float,
    *,
    solids_known: bool,
) -> NDArray[np.int64]:
    """Merge pieces, the weakest opening first; return the region of each, (p,), -1 for the rest (4.1).

    `named` tells in which pieces (p,) a name stands: what is small is not merged into what has another name.
    `drawn` tells which chords (n,) are at doors that are drawn: these always separate.
    Unless `solids_known` it may be an open floor, with hardly a door.
    """

    def regions(mouth: float) -> NDArray[np.int64]:
        found = Regions(tessellation, among, named, drawn, min_area, mouth=mouth, solids_known=solids_known)
        return found.merged()

    if not solids_known:
        finely = regions(NARROWING)
        if is_open_floor(tessellation, finely, drawn):
            return finely
    return regions(MOUTH)


def is_open_floor(tessellation: Tessellation, regions: NDArray[np.int64], drawn: NDArray[np.bool_]) -> bool:
    """Tell whether rooms open to each other, with hardly a door.

    `regions` is the region of each piece, (p,); `drawn` tells which chords are doors that are drawn, (n,).
    """
    borders = borders_of(tessellation, regions, drawn)
    areas = region_areas(tessellation, regions)
    joined = rustworkx.PyGraph()
    joined.add_nodes_from(range(len(areas)))
    joined.add_edges_from_no_data([(first, second) for first, second in borders.sides.tolist()])
    parts = [float(areas[sorted(part)].sum()) for part in rustworkx.connected_components(joined)]
    hangs_together = max(parts, default=0.0) > (1.0 - FEW_DOORS) * areas.sum()
    return bool(hangs_together and np.count_nonzero(borders.is_door) < FEW_DOORS * len(borders.is_door))
