// Doors are gaps in strokes: cutting, finding and closing them.
import { isStroke, newStroke, outlineOf, roleOf, type Element, type Outline } from "./scene";
import type { Point } from "./types";

const REACH = 14; // how far from a stroke one may click [scene units at zoom 1]
const THICKNESS = 0.3; // how far beside the door walls are cut too, as a share of its width: double walls
const ALONG = 0.75; // least |cosine| between the door and a piece of wall that it cuts
const SHARE_OF_DRAWING = 1 / 16; // width of a first door, as a share of the drawing's diagonal
const END = 10; // of a stroke, that tells where it goes [scene units]
const WIDEST = 3; // widest gap that is taken for a door, in widths of usual doors

export type Gap = [Point, Point];

const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1]];
const distance = (a: Point, b: Point) => Math.hypot(a[0] - b[0], a[1] - b[1]);
const between = (a: Point, b: Point, t: number): Point => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];

function isWall(element: Element): boolean {
  return !element.isDeleted && isStroke(element) && roleOf(element) === "wall";
}

/** The width of a door in this drawing: as its other doors are, .9 m if its scale is known, else a share of it. */
export function doorWidth(elements: readonly Element[], others: readonly Gap[], metresPerUnit: number | null): number {
  if (metresPerUnit) return 0.9 / metresPerUnit;
  const points = elements.filter(isWall).flatMap((one) => outlineOf(one).points);
  const [xs, ys] = [points.map((p) => p[0]), points.map((p) => p[1])];
  const span = (values: number[]) => values.reduce((a, b) => Math.max(a, b), -Infinity) - values.reduce((a, b) => Math.min(a, b), Infinity);
  const usual = points.length ? Math.hypot(span(xs), span(ys)) * SHARE_OF_DRAWING : 50;
  const widths = others.map(([a, b]) => distance(a, b)).filter((w) => w > usual / 3 && w < usual * 1.5).sort((a, b) => a - b);
  return widths[Math.floor(widths.length / 2)] ?? usual;
}

/** The piece of wall nearest to a point: the foot on it and its direction; null if none is near. */
function wallAt(elements: readonly Element[], p: Point, zoom: number): { foot: Point; along: Point } | null {
  let best: { foot: Point; along: Point } | null = null;
  let least = REACH / zoom;
  for (const element of elements.filter(isWall)) {
    for (const [a, b] of piecesOf(outlineOf(element))) {
      const [length, t] = [distance(a, b), project(p, a, b)];
      const foot = between(a, b, Math.max(0, Math.min(1, t)));
      if (length > 0 && distance(p, foot) < least) {
        least = distance(p, foot);
        best = { foot, along: [(b[0] - a[0]) / length, (b[1] - a[1]) / length] };
      }
    }
  }
  return best && { ...best, along: smoothDirection(elements, best.foot, best.along) };
}

/** Hand-drawn strokes wiggle: the direction over a door's width, not of the piece under the pointer. */
function smoothDirection(elements: readonly Element[], foot: Point, along: Point): Point {
  let sum: Point = [0, 0];
  for (const element of elements.filter(isWall)) {
    for (const [a, b] of piecesOf(outlineOf(element))) {
      if (distance(between(a, b, 0.5), foot) > 30 && distance(a, b) < 60) continue;
      if (distance(foot, between(a, b, Math.max(0, Math.min(1, project(foot, a, b))))) > 6) continue;
      const d = minus(b, a);
      const sign = d[0] * along[0] + d[1] * along[1];
      if (Math.abs(sign) < ALONG * Math.hypot(...d)) continue;
      sum = [sum[0] + Math.sign(sign) * d[0], sum[1] + Math.sign(sign) * d[1]];
    }
  }
  const length = Math.hypot(...sum);
  return length > 0 ? [sum[0] / length, sum[1] / length] : along;
}

const project = (p: Point, a: Point, b: Point) => {
  const [u, v] = [minus(b, a), minus(p, a)];
  return (u[0] * v[0] + u[1] * v[1]) / Math.max(u[0] ** 2 + u[1] ** 2, 1e-12);
};

function piecesOf({ points, closed }: Outline): Gap[] {
  const pieces: Gap[] = [];
  for (let k = 0; k + 1 < points.length; k++) pieces.push([points[k]!, points[k + 1]!]);
  if (closed && points.length > 2) pieces.push([points.at(-1)!, points[0]!]);
  return pieces;
}

/** The drawing with a gap in every wall that runs along this door. */
export function cutDoor(elements: readonly Element[], [from, to]: Gap): Element[] {
  const width = distance(from, to);
  if (width < 1e-6) return [...elements];
  const along: Point = [(to[0] - from[0]) / width, (to[1] - from[1]) / width];
  const middle = between(from, to, 0.5);
  return elements.flatMap((element) => {
    if (!isWall(element)) return [element];
    const outline = outlineOf(element);
    const rest = withoutBox(outline, middle, along, width / 2, Math.max(THICKNESS * width, 4));
    if (!rest) return [element];
    const type = element.type === "freedraw" ? "freedraw" : "line";
    return [
      { ...element, isDeleted: true, version: element.version + 1, versionNonce: element.versionNonce + 1 } as Element,
      ...rest.map((points) => newStroke(points, element, type)),
    ];
  });
}

/** What is left of a polyline beside a box about the door; null if it is not cut. */
function withoutBox(outline: Outline, middle: Point, along: Point, half: number, thickness: number): Point[][] | null {
  const local = ([x, y]: Point): Point => {
    const d = minus([x, y], middle);
    return [d[0] * along[0] + d[1] * along[1], -d[0] * along[1] + d[1] * along[0]];
  };
  const parts: Point[][] = [];
  let part: Point[] = [];
  let isCut = false;
  const end = () => {
    if (part.length > 1) parts.push(part);
    part = [];
  };
  for (const [a, b] of piecesOf(outline)) {
    const inside = isParallel(minus(b, a), along) ? spanInside(local(a), local(b), half, thickness) : null;
    if (part.length === 0) part = [a];
    if (!inside) {
      part.push(b);
      continue;
    }
    isCut = true;
    if (inside[0] > 1e-9) part.push(between(a, b, inside[0]));
    end();
    if (inside[1] < 1 - 1e-9) part = [between(a, b, inside[1]), b];
  }
  end();
  if (!isCut) return null;
  const [first, last] = [parts[0], parts.at(-1)];
  if (outline.closed && first && last && parts.length > 1 && distance(first[0]!, last.at(-1)!) < 1e-6) {
    parts[0] = [...last, ...first.slice(1)];
    parts.pop();
  }
  return parts.filter((points) => pathLength(points) > 1);
}

const pathLength = (points: Point[]) => points.slice(1).reduce((sum, p, k) => sum + distance(points[k]!, p), 0);

const isParallel = (d: Point, along: Point) => {
  const length = Math.hypot(...d);
  return length > 0 && Math.abs(d[0] * along[0] + d[1] * along[1]) >= ALONG * length;
};

/** The part [t0, t1] of a segment that lies in the box |x| < half, |y| < thickness (Liang and Barsky 1984). */
function spanInside(a: Point, b: Point, half: number, thickness: number): [number, number] | null {
  let [t0, t1] = [0, 1];
  for (const [axis, limit] of [[0, half], [1, thickness]] as const) {
    const [from, step] = [a[axis], b[axis] - a[axis]];
    if (Math.abs(step) < 1e-12) {
      if (Math.abs(from) >= limit) return null;
      continue;
    }
    const crossings = [(-limit - from) / step, (limit - from) / step].sort((x, y) => x - y);
    [t0, t1] = [Math.max(t0, crossings[0]!), Math.min(t1, crossings[1]!)];
  }
  return t1 - t0 > 1e-9 ? [t0, t1] : null;
}

/** The door at a point: ends of strokes that face each other, one pair for each line of the wall, the nearest first. */
function gapsAt(elements: readonly Element[], p: Point, width: number, zoom: number): Gap[] {
  const ends = elements.filter(isWall).flatMap((element) => {
    const { points, closed } = outlineOf(element);
    return closed || points.length < 2 ? [] : [
      { at: points[0]!, out: endDirection(points) },
      { at: points.at(-1)!, out: endDirection([...points].reverse()) },
    ];
  });
  const found: { gap: Gap; off: number }[] = [];
  ends.forEach((a, k) => {
    for (const b of ends.slice(k + 1)) {
      const wide = distance(a.at, b.at);
      if (wide < 2 || wide > WIDEST * width) continue;
      const d = unit(minus(b.at, a.at));
      if (dot(a.out, d) < ALONG || dot(b.out, d) > -ALONG) continue;
      const off = distance(p, between(a.at, b.at, Math.max(0, Math.min(1, project(p, a.at, b.at)))));
      if (off < REACH / zoom) found.push({ gap: [a.at, b.at], off });
    }
  });
  const [nearest, ...others] = found.sort((a, b) => a.off - b.off).map((one) => one.gap);
  if (!nearest) return [];
  const near = THICKNESS * width;
  const isBeside = ([a, b]: Gap) =>
    (distance(a, nearest[0]) < near && distance(b, nearest[1]) < near) || (distance(a, nearest[1]) < near && distance(b, nearest[0]) < near);
  return [nearest, ...others.filter(isBeside)];
}

/** The direction in which a stroke would go on beyond its first point. */
function endDirection(points: Point[]): Point {
  const first = points[0]!;
  return unit(minus(first, points.find((one) => distance(first, one) > END) ?? points.at(-1)!));
}

const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1];
const unit = (d: Point): Point => {
  const length = Math.hypot(...d) || 1;
  return [d[0] / length, d[1] / length];
};

/** Where a door goes that is dragged: an end widens it, its middle moves it. */
function draggedDoor([a, b]: Gap, from: Point, to: Point): Gap {
  const t = project(from, a, b);
  const shift = project(to, a, b) - t;
  if (t < 0.25) return [between(a, b, Math.min(shift, 0.9)), b];
  if (t > 0.75) return [a, between(a, b, 1 + Math.max(shift, -0.9))];
  return [between(a, b, shift), between(a, b, 1 + shift)];
}

/** Where the door tool puts a door that is clicked or dragged, and the door that it moves there; null if no wall is near. */
export function doorFor(elements: readonly Element[], width: number, zoom: number, from: Point, to: Point, isClick: boolean): { door: Gap; moved: Gap[] } | null {
  const moved = isClick ? [] : gapsAt(elements, from, width, zoom);
  if (moved[0]) return { door: draggedDoor(moved[0], from, to), moved };
  const wall = wallAt(elements, from, zoom);
  return wall && { door: isClick ? doorAbout(wall.foot, wall.along, width) : doorBetween(wall.foot, wall.along, to), moved: [] };
}

/** The drawing with this gap closed by a stroke. */
export function closeGap(elements: readonly Element[], gap: Gap): Element[] {
  return [...elements, newStroke(gap)];
}

/** A door of this width about a point of a wall. */
function doorAbout(foot: Point, along: Point, width: number): Gap {
  const half = width / 2;
  return [
    [foot[0] - half * along[0], foot[1] - half * along[1]],
    [foot[0] + half * along[0], foot[1] + half * along[1]],
  ];
}

/** A door from a press to a release along a wall. */
function doorBetween(foot: Point, along: Point, to: Point): Gap {
  return [foot, between(foot, [foot[0] + along[0], foot[1] + along[1]], dot(minus(to, foot), along))];
}
