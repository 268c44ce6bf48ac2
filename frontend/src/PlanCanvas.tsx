// A canvas that shows a plan as large as it fits; wheel zooms, two fingers or an empty drag pan. Points come back in plan units.
import { useEffect, useRef, useState } from "react";
import { cross, type Brush } from "./paint";
import type { Point } from "./types";

const AIR = 0.05; // around the plan, as a share of its size
const LARGEST_ZOOM = 12;

const STEP_PX = 10; // of the keyboard's marker

/** What the keyboard does on the plan: arrow keys move a marker, Enter uses it, Escape leaves. */
export interface Aim {
  name: string;
  from: Point; // where the marker begins
  use: (at: Point) => void;
  moved: (at: Point) => void;
  leave: () => void;
}

interface Props {
  bounds: [number, number, number, number];
  paint: (brush: Brush) => void;
  label: string;
  grabs?: (at: Point, pixel: number) => boolean; // whether a press here belongs to `onDrag`, not to panning
  onDrag?: (from: Point, to: Point, released: boolean) => void;
  onPress?: (at: Point) => void;
  cursor?: string;
  places?: Record<string, string>; // told as attributes, for tests
  aim?: Aim | undefined;
  testId: string;
}

export function PlanCanvas({ bounds, paint, label, grabs, onDrag, onPress, cursor, places, aim, testId }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [size, setSize] = useState<[number, number]>([0, 0]);
  const [view, setView] = useState({ zoom: 1, x: 0, y: 0 });
  const [marker, setMarker] = useState<Point | null>(null);
  const aimedAt = useRef<Point>([0, 0]); // before the first key; the marker is not shown yet
  const gesture = useRef<{ from: Point; screen: Point; mine: boolean; moved: boolean } | null>(null);

  useEffect(() => {
    const watcher = new ResizeObserver(([entry]) => entry && setSize([entry.contentRect.width, entry.contentRect.height]));
    watcher.observe(canvas.current!);
    return () => watcher.disconnect();
  }, []);

  // Keys go to the plan as long as something is aimed at, and then back to where they went before.
  useEffect(() => {
    setMarker(null);
    if (!aim) return;
    const before = document.activeElement as HTMLElement | null;
    aimedAt.current = aim.from;
    canvas.current!.focus();
    aim.moved(aim.from);
    return () => before?.focus();
  }, [aim?.name]);

  const [left, top, right, bottom] = bounds;
  const fit = Math.min(size[0] / ((right - left) * (1 + 2 * AIR) || 1), size[1] / ((bottom - top) * (1 + 2 * AIR) || 1)) || 1;
  const scale = fit * view.zoom;
  const shift: Point = [size[0] / 2 + view.x - (scale * (left + right)) / 2, size[1] / 2 + view.y - (scale * (top + bottom)) / 2];

  useEffect(() => {
    const element = canvas.current!;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(size[0] * ratio), Math.round(size[1] * ratio)];
    if (element.width !== width) element.width = width;
    if (element.height !== height) element.height = height;
    const context = element.getContext("2d")!;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.setTransform(ratio * scale, 0, 0, ratio * scale, ratio * shift[0], ratio * shift[1]);
    paint({ context, pixel: 1 / scale });
    if (marker) cross({ context, pixel: 1 / scale }, marker);
  });

  useEffect(() => {
    const element = canvas.current!;
    const zoom = (event: WheelEvent) => {
      event.preventDefault();
      const box = element.getBoundingClientRect();
      const [x, y] = [event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2];
      setView((before) => {
        const zoomed = Math.max(1, Math.min(LARGEST_ZOOM, before.zoom * Math.exp(-event.deltaY / 400)));
        const factor = zoomed / before.zoom;
        return zoomed === 1 ? { zoom: 1, x: 0, y: 0 } : { zoom: zoomed, x: x - factor * (x - before.x), y: y - factor * (y - before.y) };
      });
    };
    element.addEventListener("wheel", zoom, { passive: false });
    return () => element.removeEventListener("wheel", zoom);
  }, []);

  const at = (event: React.PointerEvent): { plan: Point; screen: Point } => {
    const box = canvas.current!.getBoundingClientRect();
    const screen: Point = [event.clientX - box.left, event.clientY - box.top];
    return { plan: [(screen[0] - shift[0]) / scale, (screen[1] - shift[1]) / scale], screen };
  };

  const onKey = (event: React.KeyboardEvent) => {
    if (!aim) return;
    if (event.key === "Escape") return aim.leave();
    const [x, y] = marker ?? aimedAt.current;
    const step = ((event.shiftKey ? 5 : 1) * STEP_PX) / scale;
    const moved: Record<string, Point> = { ArrowLeft: [x - step, y], ArrowRight: [x + step, y], ArrowUp: [x, y - step], ArrowDown: [x, y + step] };
    const next = moved[event.key] ?? [x, y];
    if (!moved[event.key] && event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    setMarker(next);
    if (moved[event.key]) aim.moved(next);
    else aim.use(next);
  };

  return (
    <canvas
      ref={canvas}
      className="plan"
      role={aim ? "application" : "img"}
      tabIndex={aim ? 0 : undefined}
      aria-label={aim ? `${aim.name}: arrow keys move the marker, Enter uses it, Escape leaves. ${label}` : label}
      data-testid={testId}
      data-scale={scale}
      data-shift={shift.join(",")}
      {...places}
      style={{ cursor }}
      onKeyDown={onKey}
      onPointerDown={(event) => {
        const { plan, screen } = at(event);
        event.currentTarget.setPointerCapture(event.pointerId);
        setMarker(null);
        gesture.current = { from: plan, screen, mine: !!grabs?.(plan, 1 / scale), moved: false };
      }}
      onPointerMove={(event) => {
        const now = gesture.current;
        if (!now) return;
        const { plan, screen } = at(event);
        const [dx, dy] = [screen[0] - now.screen[0], screen[1] - now.screen[1]];
        if (!now.moved && Math.hypot(dx, dy) < 5) return;
        now.moved = true;
        if (now.mine) onDrag?.(now.from, plan, false);
        else {
          setView((before) => ({ ...before, x: before.x + dx, y: before.y + dy }));
          now.screen = screen;
        }
      }}
      onPointerUp={(event) => {
        const now = gesture.current;
        gesture.current = null;
        if (!now) return;
        const { plan } = at(event);
        if (now.mine && now.moved) onDrag?.(now.from, plan, true);
        else if (!now.moved) onPress?.(plan);
      }}
      onPointerCancel={() => (gesture.current = null)}
    />
  );
}
