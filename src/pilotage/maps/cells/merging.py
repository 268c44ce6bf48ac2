"""Merge pieces across weak openings until each is what a person would name (Wolter 2001, section 4.1).

An opening separates two cells if it narrows, has depth behind it, or stands between jambs (decision 0010).
"""

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray

from pilotage.geometry import Array
from pilotage.maps.cells.tessellation import Tessellation

NARROWING = 1.42
"""Both sides are this many times as wide as the opening: a door. Where two corridors cross, free space is
sqrt(2) times as wide as they are, and that is none."""

MOUTH, MOUTH_DEPTH = 1.8, 0.3
"""Or one side is this many times as wide, and the smaller side has this area, in squares over the opening."""

FEW_DOORS = 1 / 8
"""On an open floor a smaller share of all openings are doors, and of its area closed off. There it is a mouth
if only one side is as much wider as both are at a door."""

JAMBS, JAMBS_NARROWING, JAMBS_DEPTH = 1.25, 1.1, 0.6
"""Or free space widens this many times beside it, with a lower narrowing and this area: a wide door."""

THRESHOLD_DEPTH, THRESHOLD_WIDTH = 1.0, 0.7
"""A threshold is no deeper than its doors are wide, and these are this share of its own width."""

COLUMN = 0.5
"""What parts two openings is a column, no wall, if it is no wider than this share of one of them."""

CORRIDOR_MOUTH, CORRIDOR_WIDTH = 2.3, 2.5
"""A corridor leads on where its wider side is less than so many times as wide as the opening, and the opening
less than so many doors wide."""

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
        self.drawn: list[bool] = drawn.tolist()
        self.told: list[bool] = tessellation.told.tolist()
        self.beside = neighbors(tessellation) if solids_known else None
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
        """Tell how much openings separate two regions, of which the smaller has this area."""
        chords = [chord for chord in self.chords_to[first][second] if not self.drawn[chord]]
        if not chords:
            return np.inf  # doors are drawn, and nothing else lies between
        opening = self.widest_opening(chords)
        narrow, wide = sorted((self.reaches[first], self.reaches[second]))
        narrowing, mouth, depth = narrow / opening, wide / opening, smaller / opening**2
        jambs = max(self.jambs[chord] * self.widths[chord] for chord in chords) / opening
        return max(
            narrowing / NARROWING,
            min(mouth / self.mouth, depth / MOUTH_DEPTH),
            min(jambs / JAMBS, narrowing / JAMBS_NARROWING, depth / JAMBS_DEPTH),
        )

    def widest_opening(self, chords: Sequence[int]) -> float:
        """Add up the widths of chords, where solids are known of those that only columns part: the most."""
        if self.beside is None or len(chords) == 1:
            return sum(self.widths[chord] for chord in chords)
        left, most = set(chords), 0.0
        while left:
            front, total = [left.pop()], 0.0
            while front:
                chord = front.pop()
                total += self.widths[chord]
                beside = self.beside.get(chord, set()) & left
                left -= beside
                front.extend(beside)
            most = max(most, total)
        return most

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


def neighbors(tessellation: Tessellation) -> dict[int, set[int]]:
    """Find for each chord the others that no more than a column parts from it."""
    lines = shapely.linestrings(tessellation.chords)
    reach = COLUMN * tessellation.widths
    found: dict[int, set[int]] = {}
    first, second = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=reach)
    for one, other in zip(first.tolist(), second.tolist(), strict=True):
        if one != other:
            found.setdefault(one, set()).add(other)
            found.setdefault(other, set()).add(one)
    return found


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
    Two doors beside each other are no wide opening if `solids_known`: else a hand may have broken the line,
    and may also have drawn an open floor, with hardly a door.
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
    """Tell whether rooms open to each other, with hardly a door."""
    borders = borders_of(tessellation, regions, drawn)
    areas = region_areas(tessellation, regions)
    joined = rustworkx.PyGraph()
    joined.add_nodes_from(range(len(areas)))
    joined.add_edges_from_no_data([(first, second) for first, second in borders.sides.tolist()])
    parts = [float(areas[sorted(part)].sum()) for part in rustworkx.connected_components(joined)]
    hangs_together = max(parts, default=0.0) > (1.0 - FEW_DOORS) * areas.sum()
    return bool(hangs_together and np.count_nonzero(borders.is_door) < FEW_DOORS * len(borders.is_door))


def join_thresholds(tessellation: Tessellation, regions: NDArray[np.int64]) -> NDArray[np.int64]:
    """Join the space within the thickness of a wall, under a door's lintel, to the larger room beside it."""
    joined = regions.copy()
    areas = region_areas(tessellation, regions)
    sides = regions[tessellation.sides]
    for number in np.flatnonzero(areas > 0.0):
        beside = (sides == number).any(axis=1) & (sides[:, 0] != sides[:, 1]) & (sides >= 0).all(axis=1)
        widths = tessellation.widths[beside]
        others = np.where(sides[beside, 0] == number, sides[beside, 1], sides[beside, 0])
        if len(np.unique(others)) != 2 or areas[number] > THRESHOLD_DEPTH * widths.min() ** 2:
            continue
        if widths.min() >= THRESHOLD_WIDTH * tessellation.reaches[regions == number].max():
            joined[regions == number] = others[np.argmax(areas[others])]
    return joined


def join_corridors(
    tessellation: Tessellation,
    regions: NDArray[np.int64],
    named: NDArray[np.bool_],
    drawn: NDArray[np.bool_],
) -> NDArray[np.int64]:
    """Join the pieces of corridors: what leads on through an opening as wide as itself, without a door.

    Where walls have a thickness a door shows as a narrowing of both sides, between jambs; a corridor that
    turns, branches or widens hardly narrows, or goes on behind the opening as narrow as that. A niche leads
    nowhere and stays what it is, and so does a wide room with a name. Two names are never joined; `named`
    tells in which pieces (p,) one stands, and `drawn` which chords (n,) are at doors that are drawn.
    """
    has_name = np.zeros(len(regions), dtype=bool)
    has_name[regions[named & (regions >= 0)]] = True
    found = borders_of(tessellation, regions, drawn)
    borders, openings, reaches, is_door = found.sides, found.openings, found.reaches, found.is_door
    wide = reaches[borders].max(axis=1)
    if not is_door.any():
        return regions
    door = float(np.median(openings[is_door]))
    is_niche = (np.bincount(borders.ravel())[borders] == 1).any(axis=1) & ~is_door
    leads_on = np.bincount(borders[~is_niche].ravel(), minlength=len(regions)) > 1
    is_room = has_name & (reaches > CORRIDOR_WIDTH * door)
    is_same = ~is_door & (wide < CORRIDOR_MOUTH * openings) & (openings < CORRIDOR_WIDTH * door)
    is_same &= (leads_on & ~is_room)[borders].all(axis=1)
    joined = np.arange(len(regions))
    for first, second in joined[borders[is_same][np.argsort(-openings[is_same], kind="stable")]]:
        one, other = joined[first], joined[second]
        if one != other and not (has_name[one] and has_name[other]):
            has_name[one] |= has_name[other]
            joined[joined == other] = one
    return np.where(regions >= 0, joined[regions], -1)


@dataclass(frozen=True, eq=False)
class Borders:
    """The pairs of regions with openings between them."""

    sides: NDArray[np.int64]  # (n, 2)
    openings: Array  # (n,) how wide the widest of each is
    is_door: NDArray[np.bool_]  # (n,) whether doors are drawn in all, or both sides narrow to jambs
    reaches: Array  # how wide each region is, indexed by its number


def borders_of(tessellation: Tessellation, regions: NDArray[np.int64], drawn: NDArray[np.bool_]) -> Borders:
    """List the pairs of regions with openings between them."""
    reaches = np.zeros(len(regions))
    np.maximum.at(reaches, regions[regions >= 0], tessellation.reaches[regions >= 0])
    sides = regions[tessellation.sides]
    between = (sides >= 0).all(axis=1) & (sides[:, 0] != sides[:, 1])
    pairs, owner = np.unique(np.sort(sides[between], axis=1), axis=0, return_inverse=True)
    openings, jambs = np.zeros(len(pairs)), np.zeros(len(pairs))
    np.maximum.at(openings, owner.ravel(), tessellation.widths[between])
    others = np.bincount(owner.ravel(), ~drawn[between], minlength=len(pairs))
    widening = np.maximum(tessellation.jambs, tessellation.behind)[between]
    np.maximum.at(jambs, owner.ravel(), widening)  # how far free space widens beside an opening
    narrow = reaches[pairs].min(axis=1)
    is_door = ((narrow >= NARROWING * openings) & (jambs >= JAMBS)) | (others == 0)
    return Borders(pairs, openings, is_door, reaches)


def drop_small(
    tessellation: Tessellation, regions: NDArray[np.int64], named: NDArray[np.bool_], min_area: float
) -> NDArray[np.int64]:
    """Drop regions that are still too small because nothing opens to them, and have no name: -1."""
    areas = region_areas(tessellation, regions)
    numbers = np.flatnonzero(areas > 0.0)
    small = numbers[areas[numbers] < min_area * areas.sum()]
    small = np.setdiff1d(small, regions[named])
    return np.where(np.isin(regions, small), -1, regions)


def region_areas(tessellation: Tessellation, regions: NDArray[np.int64]) -> Array:
    """Sum the area of each region, indexed by its number."""
    kept = regions >= 0
    return np.bincount(regions[kept], tessellation.areas[kept], minlength=len(regions)).astype(np.float64)
