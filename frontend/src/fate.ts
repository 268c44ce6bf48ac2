// What a person may do to a drive, and where in words: for those who do it by keyboard and hear the page.
import type { Point, Segment, Session, World } from "./types";

export type Fate = "none" | "goal" | "carry" | "door" | "box" | "person" | "start";

export const FATES: { fate: Fate; text: string; hint: string }[] = [
  { fate: "goal", text: "New goal", hint: "click a place on the drawing, or arrow keys and Enter" },
  { fate: "carry", text: "Carry", hint: "click in the world, or arrow keys and Enter: the robot is carried there, and nobody tells it" },
  { fate: "door", text: "Door", hint: "click a door in the world, or Enter for the one next to the robot: it closes or opens" },
  { fate: "box", text: "Box", hint: "click in the world, or arrow keys and Enter: a box is put there" },
  { fate: "person", text: "Person", hint: "click in the world, or arrow keys and Enter: someone walks there" },
];

type Door = World["doors"][number];

export const middleOf = ([x1, y1, x2, y2]: Segment): Point => [(x1 + x2) / 2, (y1 + y2) / 2];

const distance = (a: Point, b: Point) => Math.hypot(a[0] - b[0], a[1] - b[1]);

export function nearestDoor(world: World | null, at: Point): Door | null {
  const off = (door: Door) => distance(middleOf(door.segment), at);
  return [...(world?.doors ?? [])].sort((a, b) => off(a) - off(b))[0] ?? null;
}

/** A point of the world in words, y down. */
export function whereInWorld(at: Point, robot: Point, door: Door | null): string {
  if (door) return `${door.closed ? "closed" : "open"} door: ${offset(at, middleOf(door.segment))}`;
  return `robot: ${offset(at, robot)}`;
}

export function whereOnDrawing(at: Point, session: Session | null): string {
  const off = (one: { x: number; y: number }) => distance([one.x, one.y], at);
  const nearest = [...(session?.drawing.labels ?? [])].sort((a, b) => off(a) - off(b))[0];
  return nearest ? `nearest name: ${nearest.text}` : "";
}

function offset([x, y]: Point, [u, v]: Point): string {
  const told = [[u - x, "right", "left"], [v - y, "below", "above"]] as const;
  const words = told.flatMap(([way, more, less]) => (Math.abs(way) < 0.05 ? [] : [`${Math.abs(way).toFixed(1)} m ${way > 0 ? more : less}`]));
  return words.join(", ") || "here";
}
