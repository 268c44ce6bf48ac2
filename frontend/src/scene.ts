// Elements of the editor as marks of a drawing: their role, their centre line, and new ones from points.
import { restoreElements } from "@excalidraw/excalidraw";
import type { ExcalidrawElement } from "@excalidraw/excalidraw/element/types";
import type { Point, Pose, Zones } from "./types";

export type Element = ExcalidrawElement;
export type Style = "wall" | "furniture" | "ignore" | keyof Zones;
export type Role = Style | "goal" | "start" | "measure";

export const INK = "#20262e";
export const GOAL = "#e0a100";
export const TRAIL = "#1f6f8b";

/** The color of a stroke tells its role, so that a person sees it and the editor's pen carries it on. */
export const COLOR: Record<Style, string> = {
  wall: INK,
  furniture: "#b58a5a",
  ignore: "#b9bfc8",
  "keep-out": "#d9485f",
  slow: "#d98a1f",
  "one-way": "#7a5fc0",
};
export const STYLES = Object.keys(COLOR) as Style[];
/** The pen of the editor with which a style is drawn; the present one where none is named. */
export const PEN: Partial<Record<Style, "rectangle" | "arrow">> = { "keep-out": "rectangle", slow: "rectangle", "one-way": "arrow" };
export const STYLE_HINT: Partial<Record<Style, string>> = {
  "keep-out": "Outline where the robot must not drive",
  slow: "Outline where the robot drives slowly",
  "one-way": "Draw an arrow through a door: it is passed only this way",
};

const CHORDS = 8; // that a curve is cut into between two points
const ROUND_SHARE = 0.25; // radius of a rounded corner, as a share of the shorter side
const ROUND_LARGEST = 32;

export function roleOf(element: Element): Role {
  const told = element.customData?.role as Role | undefined;
  if (told === "goal" || told === "start" || told === "measure") return told;
  if (element.type === "image") return "ignore";
  const colored = STYLES.find((style) => style !== "wall" && element.strokeColor === COLOR[style] && (isStroke(element) || !PEN[style]));
  if (colored) return colored;
  if (told && told !== "wall") return told;
  return element.type === "arrow" || element.type === "frame" ? "ignore" : "wall";
}

export function isStroke(element: Element): boolean {
  return ["line", "arrow", "freedraw", "rectangle", "diamond", "ellipse"].includes(element.type);
}

export interface Outline {
  points: Point[];
  closed: boolean;
}

/** The centre line of a stroke in scene coordinates. */
export function outlineOf(element: Element): Outline {
  const { width: w, height: h } = element;
  let points: Point[];
  let closed = true;
  if (element.type === "rectangle") {
    points = element.roundness ? roundedBox(w, h) : [[0, 0], [w, 0], [w, h], [0, h]];
  } else if (element.type === "diamond") {
    points = [[w / 2, 0], [w, h / 2], [w / 2, h], [0, h / 2]];
  } else if (element.type === "ellipse") {
    points = arc(w / 2, h / 2, w / 2, h / 2, 0, 2 * Math.PI, 48).slice(0, -1);
  } else if (element.type === "line" || element.type === "arrow" || element.type === "freedraw") {
    const own = element.points.map((p) => [p[0], p[1]] as Point);
    const smooth = element.type !== "freedraw" && element.roundness && own.length > 2;
    points = smooth ? spline(own) : own;
    const [first, last] = [points[0], points.at(-1)];
    closed = points.length > 3 && !!first && !!last && Math.hypot(first[0] - last[0], first[1] - last[1]) < 1e-6;
    if (closed) points.pop();
  } else {
    return { points: [], closed: false };
  }
  return { points: placed(points, element), closed };
}

function placed(points: Point[], element: Element): Point[] {
  const xs = points.map((p) => p[0]);
  const ys = points.map((p) => p[1]);
  const middle: Point = [(min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2];
  const [c, s] = [Math.cos(element.angle), Math.sin(element.angle)];
  return points.map(([x, y]) => {
    const [dx, dy] = [x - middle[0], y - middle[1]];
    return [element.x + middle[0] + c * dx - s * dy, element.y + middle[1] + s * dx + c * dy];
  });
}

const min = (values: number[]) => values.reduce((a, b) => Math.min(a, b), Infinity);
const max = (values: number[]) => values.reduce((a, b) => Math.max(a, b), -Infinity);

function arc(cx: number, cy: number, rx: number, ry: number, from: number, turn: number, chords: number): Point[] {
  return Array.from({ length: chords + 1 }, (_, k) => {
    const angle = from + (turn * k) / chords;
    return [cx + rx * Math.cos(angle), cy + ry * Math.sin(angle)];
  });
}

function roundedBox(w: number, h: number): Point[] {
  const r = Math.min(ROUND_SHARE * Math.min(Math.abs(w), Math.abs(h)), ROUND_LARGEST);
  const quarter = (x: number, y: number, from: number) => arc(x, y, r, r, from, Math.PI / 2, 4);
  return [
    ...quarter(w - r, r, -Math.PI / 2),
    ...quarter(w - r, h - r, 0),
    ...quarter(r, h - r, Math.PI / 2),
    ...quarter(r, r, Math.PI),
  ];
}

/** A Catmull-Rom spline through points, cut into chords. */
function spline(points: Point[]): Point[] {
  const at = (k: number) => points[Math.max(0, Math.min(points.length - 1, k))]!;
  const curve: Point[] = [at(0)];
  for (let k = 0; k + 1 < points.length; k++) {
    const [a, b, c, d] = [at(k - 1), at(k), at(k + 1), at(k + 2)];
    for (let n = 1; n <= CHORDS; n++) {
      const t = n / CHORDS;
      curve.push([0, 1].map((i) => catmullRom(a[i]!, b[i]!, c[i]!, d[i]!, t)) as Point);
    }
  }
  return curve;
}

function catmullRom(a: number, b: number, c: number, d: number, t: number): number {
  return 0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t ** 2 + (3 * b - a - 3 * c + d) * t ** 3);
}

const BASE = { roughness: 0, strokeWidth: 2, roundness: null, opacity: 100, angle: 0 };

function restored(partial: Record<string, unknown>): Element {
  const id = crypto.getRandomValues(new Uint32Array(2)).join("");
  const seed = crypto.getRandomValues(new Uint32Array(1))[0]! >>> 1;
  const whole = { ...BASE, id, seed, versionNonce: seed, version: 1, ...partial };
  return restoreElements([whole as unknown as Element], null)[0]!;
}

/** A line or a freehand stroke through points of the scene. */
export function newStroke(points: Point[], like: Partial<Element> = {}, type = "line"): Element {
  const [x, y] = points[0]!;
  const own = points.map((p) => [p[0] - x, p[1] - y] as Point);
  const [xs, ys] = [own.map((p) => p[0]), own.map((p) => p[1])];
  return restored({
    strokeColor: like.strokeColor ?? INK,
    strokeWidth: like.strokeWidth ?? 2,
    customData: like.customData,
    type,
    x,
    y,
    points: own,
    width: max(xs) - min(xs),
    height: max(ys) - min(ys),
    ...(type === "freedraw" ? { pressures: [], simulatePressure: true } : {}),
  });
}

const LINE_HEIGHT = 1.25; // of the editor's handwriting, in sizes of the font

export function newText(text: string, [x, y]: Point, fontSize: number): Element {
  const pen = document.createElement("canvas").getContext("2d")!;
  pen.font = `${fontSize}px Excalifont, sans-serif`;
  const [width, height] = [Math.max(pen.measureText(text).width, 1), LINE_HEIGHT * fontSize];
  return restored({ type: "text", text, originalText: text, x: x - width / 2, y: y - height / 2, width, height, fontSize, fontFamily: 5, lineHeight: LINE_HEIGHT, strokeColor: INK, textAlign: "center", autoResize: true });
}

export function newGoal([x, y]: Point, size: number): Element {
  return restored({ type: "ellipse", x: x - size / 2, y: y - size / 2, width: size, height: size, strokeColor: GOAL, customData: { role: "goal" } });
}

export function newStart([x, y]: Point, tip: Point): Element {
  const end: Point = [tip[0] - x, tip[1] - y];
  return restored({ type: "arrow", x, y, points: [[0, 0], end], width: Math.abs(end[0]), height: Math.abs(end[1]), strokeColor: TRAIL, strokeWidth: 4, endArrowhead: "triangle", customData: { role: "start" } });
}

export function newMeasure(from: Point, to: Point, metres: number): Element {
  return newStroke([from, to], { strokeColor: TRAIL, strokeWidth: 1, customData: { role: "measure", metres } });
}

export function newPicture(fileId: string, [left, top, right, bottom]: [number, number, number, number]): Element {
  return restored({ type: "image", fileId, status: "saved", scale: [1, 1], x: left, y: top, width: right - left, height: bottom - top, opacity: 35, locked: true, strokeColor: "transparent" });
}

/** Where the drawing marks the goal, if it does: the last mark counts. */
export function goalOf(elements: readonly Element[]): Point | null {
  const mark = elements.findLast((one) => roleOf(one) === "goal");
  return mark ? [mark.x + mark.width / 2, mark.y + mark.height / 2] : null;
}

/** Position and heading of the start arrow, counter-clockwise on the page [rad]. */
export function startOf(elements: readonly Element[]): Pose | null {
  const mark = elements.findLast((one) => roleOf(one) === "start");
  if (!mark) return null;
  const line = outlineOf(mark).points;
  const [tail, tip] = [line[0], line.at(-1)];
  return tail && tip ? [tail[0], tail[1], Math.atan2(tail[1] - tip[1], tip[0] - tail[0])] : null;
}

/** Metres per unit of the drawing by the measures in it, if there are any. */
export function scaleOf(elements: readonly Element[]): number | null {
  const scales = elements
    .filter((one) => roleOf(one) === "measure")
    .map((one) => Number(one.customData?.metres) / Math.hypot(one.width, one.height))
    .filter((scale) => Number.isFinite(scale) && scale > 0);
  return scales.length ? scales.reduce((a, b) => a + b) / scales.length : null;
}

/** Give an element the color of another style. */
export const recolored = (one: Element, style: Style): Element =>
  ({ ...one, strokeColor: COLOR[style], customData: undefined, version: one.version + 1, versionNonce: one.versionNonce + 1 }) as Element;
