// What is understood, laid over the drawing: cells in soft colors, gateways, the route, and findings at their place.
import { useState } from "react";
import { CELLS, COLOR } from "./paint";
import { COLOR as STYLE } from "./scene";
import { AREAS, headOf } from "./zones";
import type { Finding, Mend, Point, Understanding } from "./types";

export interface View {
  scrollX: number;
  scrollY: number;
  zoom: number;
}

export const toScreen = (view: View, [x, y]: Point): Point => [(x + view.scrollX) * view.zoom, (y + view.scrollY) * view.zoom];
export const toScene = (view: View, [x, y]: Point): Point => [x / view.zoom - view.scrollX, y / view.zoom - view.scrollY];

const ring = (points: Point[]) => (points.length ? `M${points.map((p) => p.join(" ")).join("L")}Z` : "");

interface Props {
  told: Understanding | null;
  view: View;
  hovered: string;
  goal: Point | null;
  ends: Point[];
  preview: Point[];
  mend: (mend: Mend) => void;
}

export function Overlay({ told, view, hovered, goal, ends, preview, mend }: Props) {
  const [opened, setOpened] = useState("");
  const pixel = 1 / view.zoom;
  const colors = told ? colorsOf(told) : {};
  const open = told?.findings.find((one) => keyOf(one) === opened);
  return (
    <div className="overlay" data-testid="overlay" data-cells={told?.cells.length ?? 0}>
      <svg width="100%" height="100%" aria-hidden="true">
        <g transform={`translate(${view.scrollX * view.zoom} ${view.scrollY * view.zoom}) scale(${view.zoom})`}>
          {told?.cells.map((cell) => (
            <path key={cell.id} d={ring(cell.outline) + cell.holes.map(ring).join("")} fillRule="evenodd" fill={colors[cell.id]} fillOpacity={cell.id === hovered ? 0.5 : 0.26} />
          ))}
          {told && AREAS.flatMap((kind) => told.zones[kind].map((one, k) => (
            <path key={kind + k} d={ring(one)} fill={STYLE[kind]} fillOpacity={0.25} stroke={STYLE[kind]} strokeWidth={1.5 * pixel} strokeDasharray={`${6 * pixel} ${4 * pixel}`} data-zone={kind} />
          )))}
          {told?.zones["one-way"].map((one, k) => (
            <polyline key={k} points={[...one, ...headOf(one, 12 * pixel)].join(" ")} fill="none" stroke={STYLE["one-way"]} strokeWidth={3 * pixel} data-zone="one-way" />
          ))}
          {told?.gateways.map(({ id, segment: [a, b] }) => (
            <line key={id} x1={a[0]} y1={a[1]} x2={b[0]} y2={b[1]} stroke={COLOR.gateway} strokeWidth={4 * pixel} strokeLinecap="round" />
          ))}
          {told?.route && <polyline points={told.route.way.join(" ")} fill="none" stroke={COLOR.goal} strokeWidth={3.5 * pixel} strokeDasharray={`${2 * pixel} ${6 * pixel}`} strokeLinecap="round" data-testid="route" />}
          {told?.cells.filter((cell) => !cell.name).map((cell) => (
            <text key={cell.id} x={cell.center[0]} y={cell.center[1]} fontSize={12 * pixel} textAnchor="middle" fill={COLOR.text}>{cell.id}</text>
          ))}
          {ends.map((p, k) => <circle key={k} cx={p[0]} cy={p[1]} r={6 * pixel} fill="white" stroke={COLOR.trail} strokeWidth={2.5 * pixel} />)}
          {preview.length > 1 && <polyline points={preview.join(" ")} fill="none" stroke={COLOR.accent} strokeWidth={5 * pixel} strokeLinecap="round" />}
          {goal && <path d={starPath(goal, 10)} fill={COLOR.goal} />}
        </g>
      </svg>
      {told?.findings.map((one, k) => {
        if (!one.where) return null;
        const [left, top] = toScreen(view, one.where);
        return (
          <button
            key={keyOf(one)} className={`badge ${one.severity}`} style={{ left, top }}
            aria-label={`Finding ${k + 1}: ${one.text}`} aria-expanded={opened === keyOf(one)}
            onClick={() => setOpened(opened === keyOf(one) ? "" : keyOf(one))}
          >
            {k + 1}
          </button>
        );
      })}
      {open?.where && (
        <div className="card finding" role="dialog" aria-label="Finding" style={cardPlace(toScreen(view, open.where))}>
          <p>{open.text}</p>
          {open.mend && <button className="primary" onClick={() => { mend(open.mend!); setOpened(""); }}>{sentence(open.mend.text)}</button>}
          <button onClick={() => setOpened("")}>Close</button>
        </div>
      )}
    </div>
  );
}

export function Findings({ told, error, mend }: { told: Understanding | null; error: string; mend: (mend: Mend) => void }) {
  const [shown, setShown] = useState(false);
  const findings = told?.findings ?? [];
  const rooms = told?.cells.length ?? 0;
  const summary = error || `${count(rooms, "cell")}, ${count(told?.gateways.length ?? 0, "opening")}${findings.length ? `, ${count(findings.length, "finding")}` : rooms ? ", nothing to mend" : ""}`;
  return (
    <div className="findings">
      <button aria-expanded={shown} disabled={!findings.length} onClick={() => setShown(!shown)} data-testid="summary" className={worst(findings)}>{summary}</button>
      {shown && findings.length > 0 && (
        <ol className="card" aria-label="Findings">
          {findings.map((one) => (
            <li key={keyOf(one)} className={one.severity}>
              {one.text} {one.mend && <button onClick={() => mend(one.mend!)}>{sentence(one.mend.text)}</button>}
            </li>
          ))}
        </ol>
      )}
    </div>
  );
}

const count = (n: number, noun: string) => `${n} ${noun}${n === 1 ? "" : "s"}`;
const sentence = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);
const keyOf = (one: Finding) => `${one.kind} ${one.text} ${one.where}`;
const worst = (findings: Finding[]) => ["error", "warning", "note"].find((severity) => findings.some((one) => one.severity === severity)) ?? "";
const cardPlace = ([left, top]: Point) => ({ left: Math.max(8, left - 20), top: top + 18 });

function starPath([x, y]: Point, radius: number): string {
  return ring(Array.from({ length: 10 }, (_, k) => {
    const [angle, r] = [(k * Math.PI) / 5 - Math.PI / 2, (k % 2 ? 0.42 : 1) * radius];
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  }));
}

/** Colors such that neighbors differ, as far as there are enough of them. */
function colorsOf(told: Understanding): Record<string, string> {
  const colors: Record<string, string> = {};
  told.cells.forEach((cell, k) => {
    const taken = new Set(cell.neighbors.map((one) => colors[one.cell]));
    const rest = CELLS.filter((color) => !taken.has(color));
    colors[cell.id] = rest[k % Math.max(rest.length, 1)] ?? CELLS[k % CELLS.length]!;
  });
  return colors;
}
