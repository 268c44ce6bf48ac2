// The table's own tools beside the editor's: what they are called, and the layer that takes the pointer while one is chosen.
import { useEffect, useRef, useState } from "react";
import { toScene, type View } from "./Overlay";
import type { Point } from "./types";

export type Tool = "none" | "line" | "door" | "goal" | "start" | "measure" | "route";

export const TOOLS: { tool: Tool; text: string; sign: string; hint: string }[] = [
  { tool: "line", text: "Line", sign: "line", hint: "Drag a straight line. By keyboard: Enter, arrow keys, Enter." },
  { tool: "door", text: "Door", sign: "door", hint: "Click a wall to cut a door. Drag a door to move it, its end to widen it." },
  { tool: "goal", text: "Goal", sign: "goal", hint: "Click where the robot shall go." },
  { tool: "start", text: "Start", sign: "start", hint: "Press where the robot starts and drag to where it looks." },
  { tool: "measure", text: "Measure", sign: "measure", hint: "Drag along something whose length you know." },
  { tool: "route", text: "Route", sign: "route", hint: "Click two places to see the way between them." },
];

/** Tools that are pressed at one point and dragged to another. */
export const TWO_POINTS: readonly Tool[] = ["line", "start", "measure"];

const SIGNS: Record<string, string> = {
  line: "M4 20L20 4M2.5 20h3M18.5 4h3",
  door: "M3 20V5h5M16 5h5v15M8 20V5l7 3v15z",
  goal: "M6 22V3l12 4-12 5",
  start: "M4 20L20 4M20 4h-8M20 4v8",
  measure: "M3 12h18M3 7v10M21 7v10M8 10v4M12 9v6M16 10v4",
  route: "M5 19h8a4 4 0 0 0 0-8h-3a4 4 0 0 1 0-7h8M16 2l3 2-3 3",
};

export function Sign({ name }: { name: string }) {
  return (
    <svg viewBox="0 0 24 24" width="20" height="20" fill="none" stroke="currentColor" strokeWidth="1.8" strokeLinecap="round" strokeLinejoin="round" aria-hidden="true">
      <path d={SIGNS[name]} />
    </svg>
  );
}

interface Props {
  tool: Tool;
  view: View;
  preview: (from: Point, to: Point) => void;
  use: (from: Point, to: Point, isClick: boolean) => void;
  hover: (at: Point | null) => void;
  leave: () => void;
}

const CLICK_PX = 5; // a press that moves less is a click
const STEP_PX = 10; // of the keyboard's cross hair

export function ToolLayer({ tool, view, preview, use, hover, leave }: Props) {
  const layer = useRef<HTMLDivElement>(null);
  const from = useRef<Point | null>(null);
  const [cross, setCross] = useState<Point | null>(null);

  // Keys go to the layer as long as it is there, and then back to where they went before.
  useEffect(() => {
    const before = document.activeElement as HTMLElement | null;
    layer.current?.focus();
    return () => before?.focus();
  }, []);

  const at = (event: { clientX: number; clientY: number }): Point => {
    const box = layer.current!.getBoundingClientRect();
    return toScene(view, [event.clientX - box.left, event.clientY - box.top]);
  };
  const finish = (to: Point) => {
    const start = from.current;
    from.current = null;
    if (start) use(start, to, Math.hypot(to[0] - start[0], to[1] - start[1]) * view.zoom < CLICK_PX);
  };
  const onKey = (event: React.KeyboardEvent) => {
    if (event.key === "Escape") return leave();
    const box = layer.current!.getBoundingClientRect();
    const [x, y] = cross ?? [box.width / 2, box.height / 2];
    const step = event.shiftKey ? 5 * STEP_PX : STEP_PX;
    const moved: Record<string, Point> = { ArrowLeft: [x - step, y], ArrowRight: [x + step, y], ArrowUp: [x, y - step], ArrowDown: [x, y + step] };
    const next = moved[event.key];
    if (next) {
      event.preventDefault();
      setCross(next);
      hover(toScene(view, next));
      if (from.current) preview(from.current, toScene(view, next));
    } else if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      const point = toScene(view, [x, y]);
      setCross([x, y]);
      if (TWO_POINTS.includes(tool) && !from.current) from.current = point;
      else {
        from.current ??= point;
        finish(point);
      }
    }
  };

  return (
    <div
      ref={layer} className="tool-layer" tabIndex={0} role="application" data-testid="tool-layer"
      aria-label={`Tool ${tool}: arrow keys move the cross hair, Enter uses it, Escape leaves`}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        setCross(null);
        from.current = at(event);
      }}
      onPointerMove={(event) => {
        hover(at(event));
        if (from.current) preview(from.current, at(event));
      }}
      onPointerUp={(event) => finish(at(event))}
      onPointerCancel={() => (from.current = null)}
      onWheel={(event) => {
        const canvas = document.querySelector("canvas.interactive");
        canvas?.dispatchEvent(new WheelEvent("wheel", { ...wheelOf(event.nativeEvent), bubbles: true, cancelable: true }));
      }}
      onKeyDown={onKey}
    >
      {cross && <i className="cross" style={{ left: cross[0], top: cross[1] }} />}
    </div>
  );
}

const wheelOf = ({ deltaX, deltaY, clientX, clientY, ctrlKey, shiftKey, metaKey }: WheelEvent) => ({ deltaX, deltaY, clientX, clientY, ctrlKey, shiftKey, metaKey });
