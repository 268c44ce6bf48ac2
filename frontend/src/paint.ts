// Painting with the colors of the project's figures, on a canvas whose transform maps plan to screen.
import type { Point, Pose, Segment } from "./types";

export const COLOR = {
  ink: "#20262e",
  gray: "#8b939e",
  text: "#5b6470",
  pale: "#e6e9ed",
  trail: "#1f6f8b",
  accent: "#d1495b",
  goal: "#e0a100",
  gateway: "#4f9d69",
  door: "#8c4a2f",
  shut: "#b02a37",
  drawn: "#c3c9d1",
  person: "#7b6ca8",
  glass: "#7cc4dc",
  beam: "rgba(124, 196, 220, .22)",
} as const;

/** Soft colors of neighboring cells. */
export const CELLS = ["#8fbfd3", "#b5d19c", "#ecd08a", "#e3b0a8", "#c3b5df", "#a5d3c6"];

const ARROW: Point[] = [[0.6, 0], [-0.4, 0.36], [-0.2, 0], [-0.4, -0.36]];

export interface Brush {
  context: CanvasRenderingContext2D;
  pixel: number; // size of a screen pixel [plan units]
}

export function line({ context, pixel }: Brush, points: readonly Point[], color: string, width: number, closed = false, dash: number[] = []): void {
  if (points.length < 2) return;
  context.beginPath();
  points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
  if (closed) context.closePath();
  context.strokeStyle = color;
  context.lineWidth = width * pixel;
  context.lineCap = context.lineJoin = "round";
  context.setLineDash(dash.map((length) => length * pixel));
  context.stroke();
  context.setLineDash([]);
}

export function segments({ context, pixel }: Brush, all: readonly Segment[], color: string, width: number): void {
  context.beginPath();
  for (const [x1, y1, x2, y2] of all) {
    context.moveTo(x1, y1);
    context.lineTo(x2, y2);
  }
  context.strokeStyle = color;
  context.lineWidth = width * pixel;
  context.lineCap = "round";
  context.stroke();
}

export function dots({ context, pixel }: Brush, flat: readonly number[], color: string, radius: number, step = 2): void {
  context.fillStyle = color;
  const size = 2 * radius * pixel;
  for (let k = 0; k + 1 < flat.length; k += step) context.fillRect(flat[k]! - size / 2, flat[k + 1]! - size / 2, size, size);
}

export function disc({ context, pixel }: Brush, [x, y]: Point, color: string, radius: number): void {
  context.beginPath();
  context.arc(x, y, radius * pixel, 0, 2 * Math.PI);
  context.fillStyle = color;
  context.fill();
}

/** The robot as an arrowhead that points where it looks; headings turn counter-clockwise, y points down. */
export function robot({ context, pixel }: Brush, [x, y, heading]: Pose, color: string, size = 24, opacity = 1): void {
  const [c, s] = [Math.cos(heading), -Math.sin(heading)];
  context.beginPath();
  for (const [u, v] of ARROW) context.lineTo(x + size * pixel * (c * u - s * v), y + size * pixel * (s * u + c * v));
  context.closePath();
  context.globalAlpha = opacity;
  context.fillStyle = color;
  context.fill();
  context.strokeStyle = "white";
  context.lineWidth = 1.2 * pixel;
  context.stroke();
  context.globalAlpha = 1;
}

/** The marker of the keyboard. */
export function cross(brush: Brush, [x, y]: Point, size = 14): void {
  const arm = size * brush.pixel;
  line(brush, ring([x, y], 0.6 * arm), COLOR.accent, 2, true);
  line(brush, [[x - arm, y], [x + arm, y]], COLOR.accent, 2);
  line(brush, [[x, y - arm], [x, y + arm]], COLOR.accent, 2);
}

export const ring = ([x, y]: Point, radius: number): Point[] =>
  Array.from({ length: 24 }, (_, k) => [x + radius * Math.cos((k * Math.PI) / 12), y + radius * Math.sin((k * Math.PI) / 12)]);

export function star({ context, pixel }: Brush, [x, y]: Point, radius = 11): void {
  context.beginPath();
  for (let k = 0; k < 10; k++) {
    const angle = (k * Math.PI) / 5 - Math.PI / 2;
    const r = (k % 2 ? 0.42 : 1) * radius * pixel;
    context.lineTo(x + r * Math.cos(angle), y + r * Math.sin(angle));
  }
  context.closePath();
  context.fillStyle = COLOR.goal;
  context.fill();
  context.strokeStyle = "white";
  context.lineWidth = pixel;
  context.stroke();
}

export function words({ context, pixel }: Brush, text: string, [x, y]: Point, color: string = COLOR.text, size = 14): void {
  context.font = `italic ${size * pixel}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.strokeStyle = "rgba(255, 255, 255, .8)";
  context.lineWidth = 3 * pixel;
  context.lineJoin = "round";
  context.strokeText(text, x, y);
  context.fillStyle = color;
  context.fillText(text, x, y);
}
