// Drawings as SVG that `pilotage` reads. The editor's scene is embedded, so that opening it again loses nothing.
import { serializeAsJSON } from "@excalidraw/excalidraw";
import type { BinaryFiles } from "@excalidraw/excalidraw/types";
import { goalOf, isStroke, outlineOf, roleOf, scaleOf, startOf, type Element, type Outline } from "./scene";
import type { Point } from "./types";

const SCENE = "drawing-table-scene";
const SMOOTH = 0.4; // deviation of a simplified freehand line [scene units]
const AIR = 20; // around the drawing [scene units]

const escaped = (text: string) =>
  text.replace(/[&<>"]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]!);
const number = (value: number) => String(Math.round(value * 100) / 100);

export function drawingToSvg(all: readonly Element[], files: BinaryFiles | null): string {
  const elements = all.filter((one) => !one.isDeleted);
  const body = elements.flatMap(markOf);
  const goal = goalOf(elements);
  const start = startOf(elements);
  if (start) body.push(`<circle class="start" cx="${number(start[0])}" cy="${number(start[1])}" r="8" fill="#1f6f8b" data-heading="${number((start[2] * 180) / Math.PI)}"/>`);
  if (goal) body.push(`<circle class="goal" cx="${number(goal[0])}" cy="${number(goal[1])}" r="8" fill="#e0a100"/>`);
  const scale = scaleOf(elements);
  const [left, top, right, bottom] = boundsOf(elements);
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${[left, top, right - left, bottom - top].map(number).join(" ")}"` +
      `${scale ? ` data-metres-per-unit="${scale.toPrecision(4)}"` : ""}>`,
    ...body,
    ...(files ? [`<metadata id="${SCENE}">${escaped(sceneText(elements, files))}</metadata>`] : []),
    "</svg>",
    "",
  ].join("\n");
}

function markOf(element: Element): string[] {
  const role = roleOf(element);
  if (role === "goal" || role === "start") return [];
  const kind = role === "wall" ? "" : ` class="${role === "measure" ? "ignore" : role}"`;
  if (element.type === "text") {
    const x = element.x + element.width / 2;
    const y = element.y + element.height / 2 + 0.35 * element.fontSize;
    const words = element.text.replace(/\s+/g, " ").trim();
    return words
      ? [`<text${kind} x="${number(x)}" y="${number(y)}" font-size="${number(element.fontSize)}" font-family="sans-serif" text-anchor="middle" fill="${element.strokeColor}">${escaped(words)}</text>`]
      : [];
  }
  if (!isStroke(element)) return [];
  const outline = simplified(outlineOf(element));
  if (outline.points.length < 2) return [];
  const line = outline.points.map(([x, y]) => `${number(x)} ${number(y)}`).join(" L");
  return [
    `<path${kind} d="M${line}${outline.closed ? " Z" : ""}" fill="none" stroke="${element.strokeColor}" stroke-width="${number(element.strokeWidth)}" stroke-linecap="round" stroke-linejoin="round"/>`,
  ];
}

function simplified({ points, closed }: Outline): Outline {
  return { points: points.length > 8 ? douglasPeucker(points) : points, closed };
}

function douglasPeucker(points: Point[]): Point[] {
  const [a, b] = [points[0]!, points.at(-1)!];
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  let [worst, at] = [0, 0];
  points.forEach(([x, y], k) => {
    const across = length > 0 ? Math.abs((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / length : Math.hypot(x - a[0], y - a[1]);
    if (across > worst) [worst, at] = [across, k];
  });
  if (worst <= SMOOTH) return [a, b];
  return [...douglasPeucker(points.slice(0, at + 1)).slice(0, -1), ...douglasPeucker(points.slice(at))];
}

/** Left, top, right and bottom of all marks, with some air around them. */
export function boundsOf(elements: readonly Element[]): [number, number, number, number] {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const one of elements) {
    const points: Point[] = isStroke(one) ? outlineOf(one).points : [[one.x, one.y], [one.x + one.width, one.y + one.height]];
    for (const [x, y] of points) {
      [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, x), Math.max(bottom, y)];
    }
  }
  return left > right ? [0, 0, 100, 100] : [left - AIR, top - AIR, right + AIR, bottom + AIR];
}

/** The scene as an `.excalidraw` file, each element with its role as customData. */
export function sceneText(all: readonly Element[], files: BinaryFiles): string {
  const elements = all.map((one) => {
    const role = roleOf(one);
    return role === "wall" ? one : { ...one, customData: { ...one.customData, role } };
  });
  return serializeAsJSON(elements, { viewBackgroundColor: "#ffffff" }, files, "local");
}

export interface Scene {
  elements: Element[];
  files: BinaryFiles;
}

/** The scene of an `.excalidraw` file or of an SVG that holds one; null if there is none. */
export function sceneIn(text: string): Scene | null {
  try {
    const json = text.trimStart().startsWith("{")
      ? text
      : new DOMParser().parseFromString(text, "image/svg+xml").getElementById(SCENE)?.textContent;
    const scene = json ? (JSON.parse(json) as Partial<Scene>) : null;
    return scene && Array.isArray(scene.elements) ? { elements: scene.elements, files: scene.files ?? {} } : null;
  } catch {
    return null;
  }
}
