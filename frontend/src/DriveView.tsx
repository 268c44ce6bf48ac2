// A drive, side by side: what the robot believes on the drawing, and the world as it is.
import { useEffect, useRef, useState } from "react";
import { FATES, middleOf, nearestDoor, whereInWorld, whereOnDrawing, type Fate } from "./fate";
import { correctedNow, describeCorrected, paintCorrected } from "./corrected";
import { percent } from "./numbers";
import { COLOR, disc, dots, line, ring, robot, segments, star, words, type Brush } from "./paint";
import { PlanCanvas, type Aim } from "./PlanCanvas";
import type { Drive, Order } from "./useDrive";
import type { Point, Pose, WayPoint } from "./types";
import { startByArrow } from "./startByArrow";
import { paintZones } from "./zones";

const GRAB_PX = 26; // how near the robot a press takes it up
const TRAIL_POINTS = 2000;
const CARRIED = 2.5; // from frame to frame, that no robot drives [m]

interface Props {
  drive: Drive;
  fate: Fate;
  setFate: (fate: Fate) => void;
  send: (order: Order) => void;
}

export function DriveView({ drive, fate, setFate, send }: Props) {
  const [said, setSaid] = useState("");
  const [carried, setCarried] = useState<Point | null>(null);
  const [arrow, setArrow] = useState<Pose | null>(null);
  const [wantsCorrected, setWantsCorrected] = useState(true);
  const trail = useTrail(drive);
  const { session, frame, world } = drive;
  const believed = frame?.believed;
  const truth = frame?.world;
  const known = correctedNow(drive);
  const corrected = wantsCorrected ? known : null;
  const canCarry = session?.kind === "drive" && !drive.done;

  const paintBelieved = (brush: Brush) => {
    for (const stroke of session?.drawing.strokes ?? []) line(brush, stroke.points, corrected ? COLOR.drawn : COLOR.ink, 2.2, stroke.closed);
    if (corrected) paintCorrected(brush, corrected);
    paintZones(brush, session?.drawing.zones);
    for (const label of session?.drawing.labels ?? []) words(brush, label.text, [label.x, label.y]);
    if (believed) {
      dots(brush, believed.particles, "rgba(31, 111, 139, .35)", 1.4, 3);
      line(brush, trail.believed, COLOR.trail, 3);
      dots(brush, believed.scan, COLOR.accent, 1.3);
      line(brush, believed.route, COLOR.goal, 2.5, false, [2, 5]);
      if (believed.gateway) line(brush, believed.gateway, COLOR.gateway, 5);
      believed.places.slice(1, 5).forEach((place, k) => {
        robot(brush, place.pose, COLOR.gray, 18, 0.8);
        words(brush, `${k + 2}: ${percent(place.probability)}`, [place.pose[0], place.pose[1] + 20 * brush.pixel], COLOR.text, 11);
      });
      if (truth?.on_drawing) {
        brush.context.globalAlpha = 0.6;
        line(brush, ring([truth.on_drawing[0], truth.on_drawing[1]], 13 * brush.pixel), COLOR.ink, 1.5, true, [3, 4]);
        brush.context.globalAlpha = 1;
      }
      robot(brush, believed.pose, believed.status === "located" ? COLOR.accent : "#e79a3c");
    }
    if (session?.drawing.goal) star(brush, session.drawing.goal);
    if (arrow) robot(brush, arrow, COLOR.goal, 28, 0.7);
  };

  const paintWorld = (brush: Brush) => {
    if (!world) return;
    if (truth) paintBeams(brush, truth.pose, truth.scan);
    segments(brush, world.boxes, COLOR.ink, 1.4);
    segments(brush, world.glass, COLOR.glass, 2);
    segments(brush, world.walls, COLOR.ink, 3);
    for (const door of world.doors) {
      const [x1, y1, x2, y2] = door.segment;
      line(brush, [[x1, y1], [x2, y2]], COLOR.door, door.closed ? 4 : 1.5, false, door.closed ? [] : [2, 5]);
    }
    if (world.goal) star(brush, world.goal);
    for (const piece of trail.true) line(brush, piece, COLOR.trail, 3);
    if (truth) {
      for (const person of truth.people) disc(brush, person, COLOR.person, 6);
      robot(brush, truth.pose, COLOR.accent);
    }
    if (carried && truth) robot(brush, [carried[0], carried[1], truth.pose[2]], COLOR.accent, 28, 0.6);
  };

  const press = ([x, y]: Point) => {
    if (fate === "door") send({ type: "door", x, y, closed: !nearestDoor(world, [x, y])?.closed });
    else if (fate === "carry") send({ type: "kidnap", x, y });
    else if (fate === "box") send({ type: "box", x, y });
    else if (fate === "person") send({ type: "person", x, y });
  };

  const pressDrawing = (at: Point) => {
    if (fate !== "goal") return;
    send({ type: "goal", goal: at });
    setFate("none");
  };
  const chosen = FATES.find((one) => one.fate === fate);
  const aim = (from: Point, use: (at: Point) => void, where: (at: Point) => string): Aim | undefined =>
    chosen && { name: chosen.text, from, use, moved: (at) => setSaid(where(at)), leave: () => setFate("none") };
  const robotAt: Point = truth ? [truth.pose[0], truth.pose[1]] : [0, 0];
  const door = nearestDoor(world, robotAt);
  const doorAt = door ? middleOf(door.segment) : robotAt;
  const believedAt: Point = believed ? [believed.pose[0], believed.pose[1]] : [0, 0];

  // What came of it is said too.
  const last = drive.marks.at(-1);
  useEffect(() => setSaid(last?.kind === "fate" ? last.text : ""), [drive.marks.length, last?.text]);

  return (
    <div className="side-by-side">
      <p className="unseen" aria-live="polite" data-testid="said">{said}</p>
      <figure>
        <figcaption>
          What it believes
          {known && (
            <label className="check" title="Dashed walls were not seen yet. Doors are green where they were found open, red where closed. Pale is the drawing as it was drawn.">
              <input type="checkbox" checked={wantsCorrected} onChange={(event) => setWantsCorrected(event.target.checked)} />
              drawing as found: {describeCorrected(known)}
            </label>
          )}
        </figcaption>
        <PlanCanvas
          testId="believed"
          label={`The drawing as the robot believes it: ${frame?.text ?? "nothing yet"}${corrected ? `; ${describeCorrected(corrected)}` : ""}`}
          places={{ "data-corrected": corrected ? String(corrected.seen_share) : "" }}
          bounds={session?.drawing.bounds ?? [0, 0, 1, 1]}
          paint={paintBelieved}
          onPress={pressDrawing}
          aim={fate === "goal" ? aim(believedAt, pressDrawing, (at) => whereOnDrawing(at, session)) : undefined}
          {...startByArrow(fate, send, () => setFate("none"), setArrow)}
          cursor={fate === "goal" || fate === "start" ? "crosshair" : "grab"}
        />
      </figure>
      {world && (
        <figure>
          <figcaption>What is true</figcaption>
          <PlanCanvas
            testId="world"
            label={`The world as it is, with the robot in it.${canCarry ? " Drag the robot to carry it elsewhere." : ""}`}
            bounds={world.bounds}
            places={{ "data-robot": truth ? truth.pose.slice(0, 2).join(",") : "", "data-doors": world.doors.map((door) => middleOf(door.segment).join(",")).join(" ") }}
            paint={paintWorld}
            grabs={(at, pixel) => canCarry && !!truth && Math.hypot(at[0] - truth.pose[0], at[1] - truth.pose[1]) < GRAB_PX * pixel}
            onDrag={(_, to, released) => {
              setCarried(released ? null : to);
              if (released) send({ type: "kidnap", x: to[0], y: to[1] });
            }}
            onPress={press}
            aim={fate !== "none" && fate !== "goal" ? aim(fate === "door" ? doorAt : robotAt, press, (at) => whereInWorld(at, robotAt, fate === "door" ? nearestDoor(world, at) : null)) : undefined}
            cursor={fate === "none" || fate === "goal" ? "grab" : "crosshair"}
          />
        </figure>
      )}
    </div>
  );
}


function paintBeams({ context }: Brush, [x, y]: Pose, scan: readonly number[]): void {
  context.beginPath();
  context.moveTo(x, y);
  for (let k = 0; k + 1 < scan.length; k += 2) context.lineTo(scan[k]!, scan[k + 1]!);
  context.closePath();
  context.fillStyle = COLOR.beam;
  context.fill();
}

/** A way in pieces, broken where the robot was carried. */
function pieces(way: Point[]): Point[][] {
  const all: Point[][] = [];
  way.forEach((point, k) => {
    const before = way[k - 1];
    if (before && Math.hypot(point[0] - before[0], point[1] - before[1]) < CARRIED) all.at(-1)!.push(point);
    else all.push([point]);
  });
  return all;
}

/** The ways believed and true until the shown moment, as far as they were seen or told. A jump of the estimate begins a new line. */
function useTrail(drive: Drive): { believed: Point[]; true: Point[][] } {
  const kept = useRef<{ session: string; seen: WayPoint[] }>({ session: "", seen: [] });
  const { frame, session } = drive;
  const trail = kept.current;
  if (session && trail.session !== session.session) kept.current = { session: session.session, seen: [...(session.way ?? [])] };
  const { seen } = kept.current;
  if (frame) {
    const { pose, status } = frame.believed;
    const before = seen.findLastIndex((one) => one.t <= frame.t);
    const one: WayPoint = { t: frame.t, believed: [pose[0], pose[1]], true: frame.world ? [frame.world.pose[0], frame.world.pose[1]] : null, sure: status === "located" };
    if (seen[before]?.t !== frame.t) seen.splice(before + 1, 0, one);
    if (seen.length > TRAIL_POINTS) kept.current.seen = seen.filter((_, k) => k % 2 === 0);
  }
  const until = seen.filter((one) => one.t <= (frame?.t ?? 0));
  const lost = until.findLastIndex((one, k) => !one.sure || (k > 0 && jump(until[k - 1]!.believed, one.believed, drive)));
  return { believed: until.slice(lost + 1).map((one) => one.believed), true: pieces(until.flatMap((one) => (one.true ? [one.true] : []))) };
}

const jump = (a: Point, b: Point, drive: Drive) => Math.hypot(a[0] - b[0], a[1] - b[1]) > 2 * (drive.frame?.believed.scale ?? Infinity);
