// Cells as a person asks for them: which one is here, and what is it?
import type { Cell, Point, Understanding } from "./types";

/** The cell at a point, by the even-odd rule. */
export function cellAt(told: Understanding | null, p: Point): Cell | undefined {
  return told?.cells.find((cell) => [cell.outline, ...cell.holes].reduce((inside, one) => inside !== isInside(one, p), false));
}

function isInside(polygon: Point[], [x, y]: Point): boolean {
  let inside = false;
  polygon.forEach(([x1, y1], k) => {
    const [x2, y2] = polygon[(k + 1) % polygon.length]!;
    if (y1 > y !== y2 > y && x < ((x2 - x1) * (y - y1)) / (y2 - y1) + x1) inside = !inside;
  });
  return inside;
}

/** A cell in words; its area too if the scale is known [m per unit]. */
export function describeCell(cell: Cell, told: Understanding | null, scale: number | null): string {
  const area = scale ? `, about ${(areaOf(cell) * scale ** 2).toFixed(0)} m2` : "";
  const nameOf = (id: string) => told?.cells.find((one) => one.id === id)?.name || id;
  const ways = cell.neighbors.length ? `opens to ${cell.neighbors.map((one) => nameOf(one.cell)).join(", ")}` : "opens to no other room";
  return `${cell.name || cell.id}: ${cell.size}${area}; ${ways}`;
}

function areaOf({ outline, holes }: Cell): number {
  const ringArea = (ring: Point[]) => Math.abs(ring.reduce((sum, [x, y], k) => {
    const [u, v] = ring[(k + 1) % ring.length]!;
    return sum + x * v - u * y;
  }, 0)) / 2;
  return ringArea(outline) - holes.reduce((sum, hole) => sum + ringArea(hole), 0);
}
