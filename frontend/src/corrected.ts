// The drawing as the robot found it, painted over the drawn one.
import { COLOR, line, type Brush } from "./paint";
import { percent } from "./numbers";
import type { Corrected } from "./types";
import type { Drive } from "./useDrive";

/** What was known of the drawing at the shown moment; null if that was nothing yet. */
export function correctedNow({ corrected, frame }: Drive): Corrected | null {
  return corrected && (frame?.live || (frame?.t ?? 0) >= corrected.t) ? corrected : null;
}

export function paintCorrected(brush: Brush, { seen, unseen, passages }: Corrected): void {
  for (const points of unseen) line(brush, points, COLOR.gray, 1.8, false, [5, 6]);
  for (const points of seen) line(brush, points, COLOR.ink, 2.6);
  for (const { segment, state } of passages) {
    if (state === "open") line(brush, segment, COLOR.gateway, 3);
    if (state === "closed") line(brush, segment, COLOR.shut, 6);
  }
}

export function describeCorrected({ seen_share: share, passages }: Corrected): string {
  const doors = (["open", "closed"] as const).map((state) => [passages.filter((one) => one.state === state).length, state] as const);
  const found = doors.filter(([count]) => count).map(([count, state]) => `${count} ${count === 1 ? "door" : "doors"} ${state}`);
  return [`${percent(share)} seen (else dashed)`, ...found].join(", ");
}
