// A video of what the page shows of a drive, made by the browser's own encoder while the timeline runs through it.
import { COLOR } from "./paint";

const FRAMES_PER_SECOND = 15;
const SPEED = 10; // times as fast as the drive,
const LONGEST_S = 40; // but no longer than this
const CAPTION_PX = 44;
const BITS_PER_SECOND = 4_000_000;
const KINDS = ["video/mp4;codecs=avc1.42E01F", "video/webm;codecs=vp9", "video/webm"];

/** The kind of video that this browser can make; undefined if it makes none. */
export const filmKind = () => (typeof MediaRecorder === "undefined" ? undefined : KINDS.find((kind) => MediaRecorder.isTypeSupported(kind)));

interface Shooting {
  span: [number, number]; // of the drive [s]
  look: (t: number) => void; // asks the server for this moment
  caption: () => string;
  progress: (share: number) => void;
  signal: AbortSignal;
}

/** Shows one moment after the other, and records the plans as they are painted; null if it was given up. */
export async function shootFilm(plans: HTMLCanvasElement[], kind: string, { span: [first, last], look, caption, progress, signal }: Shooting): Promise<Blob | null> {
  const sheet = document.createElement("canvas");
  sheet.width = even(plans.reduce((sum, plan) => sum + plan.width, 0));
  sheet.height = even(Math.max(...plans.map((plan) => plan.height)) + CAPTION_PX);
  const recorder = new MediaRecorder(sheet.captureStream(FRAMES_PER_SECOND), { mimeType: kind, videoBitsPerSecond: BITS_PER_SECOND });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const stopped = new Promise((resolve) => (recorder.onstop = resolve));
  const length = 1000 * Math.max(Math.min((last - first) / SPEED, LONGEST_S), 1 / FRAMES_PER_SECOND);
  look(first);
  await pause();
  recorder.start();
  const began = performance.now();
  for (let share = 0; !signal.aborted; ) {
    look(first + (last - first) * share);
    await pause();
    lay(sheet, plans, caption());
    progress(share);
    if (share === 1) break;
    share = Math.min((performance.now() - began) / length, 1); // by the clock: a slow machine shows fewer moments
  }
  await pause();
  recorder.stop();
  await stopped;
  return signal.aborted ? null : new Blob(parts, { type: kind });
}

const pause = () => new Promise((resolve) => setTimeout(resolve, 1000 / FRAMES_PER_SECOND));
const even = (pixels: number) => 2 * Math.ceil(pixels / 2); // as H.264 wants it

function lay(sheet: HTMLCanvasElement, plans: HTMLCanvasElement[], caption: string): void {
  const pen = sheet.getContext("2d")!;
  pen.fillStyle = "white";
  pen.fillRect(0, 0, sheet.width, sheet.height);
  let left = 0;
  for (const plan of plans) {
    pen.drawImage(plan, left, 0);
    left += plan.width;
  }
  pen.fillStyle = COLOR.ink;
  pen.font = "20px system-ui, sans-serif";
  pen.textBaseline = "middle";
  pen.fillText(caption, 16, sheet.height - CAPTION_PX / 2, sheet.width - 32);
}
