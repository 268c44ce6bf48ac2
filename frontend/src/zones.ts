// Zones as they are understood: areas that the robot leaves out or crosses slowly, and arrows through doors.
import { line, type Brush } from "./paint";
import { COLOR } from "./scene";
import type { Point, Zones } from "./types";

export const AREAS = ["keep-out", "slow"] as const;
const HEAD = 9; // length of an arrow's head [px]

export function paintZones(brush: Brush, zones: Zones | undefined): void {
  if (!zones) return;
  const { context } = brush;
  for (const kind of AREAS) {
    for (const ring of zones[kind]) {
      context.beginPath();
      ring.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
      context.globalAlpha = 0.2;
      context.fillStyle = COLOR[kind];
      context.fill();
      context.globalAlpha = 1;
      line(brush, ring, COLOR[kind], 1.5, true, [6, 4]);
    }
  }
  for (const arrow of zones["one-way"]) {
    line(brush, arrow, COLOR["one-way"], 2.5);
    line(brush, headOf(arrow, HEAD * brush.pixel), COLOR["one-way"], 2.5);
  }
}

/** The two strokes at the tip of an arrow. */
export function headOf(arrow: Point[], size: number): Point[] {
  const [tail, tip] = [arrow[0], arrow.at(-1)];
  if (!tail || !tip) return [];
  const angle = Math.atan2(tip[1] - tail[1], tip[0] - tail[0]);
  const barb = (turn: number): Point => [tip[0] - size * Math.cos(angle + turn), tip[1] - size * Math.sin(angle + turn)];
  return [barb(0.5), tip, barb(-0.5)];
}
