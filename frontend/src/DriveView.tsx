// A drive, side by side: what the robot believes on the drawing, and the world as it is.
import { useRef, useState } from "react";
import { percent } from "./numbers";
import { COLOR, disc, dots, line, robot, segments, star, words, type Brush } from "./paint";
import { PlanCanvas } from "./PlanCanvas";
import { startByArrow } from "./startByArrow";
import type { Drive, Order } from "./useDrive";
import type { Point, Pose, Segment, WayPoint } from "./types";

export type Fate = "none" | "goal" | "door" | "box" | "person" | "start";

const GRAB_PX = 26; // how near the robot a press takes it up
const TRAIL_POINTS = 2000;
const CARRIED = 2.5; // from frame to frame, that no robot drives [m]

export function DriveView({ drive, fate, send, onGoal, onPlace }: { drive: Drive; fate: Fate; send: (order: Order) => void; onGoal: (at: Point) => void; onPlace: () => void }) {
  const [carried, setCarried] = useState<Point | null>(null);
  const [arrow, setArrow] = useState<Pose | null>(null);
  const trail = useTrail(drive);
  const { session, frame, world } = drive;
  const believed = frame?.believed;
  const truth = frame?.world;
  const canCarry = session?.kind === "drive" && !drive.done;

  const paintBelieved = (brush: Brush) => {
    for (const stroke of session?.drawing.strokes ?? []) line(brush, stroke.points, COLOR.ink, 2.2, stroke.closed);
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
        line(brush, ring(truth.on_drawing, 13 * brush.pixel), COLOR.ink, 1.5, true, [3, 4]);
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
    if (fate === "door") {
      const nearest = [...(world?.doors ?? [])].sort((a, b) => middleDistance(a.segment, x, y) - middleDistance(b.segment, x, y))[0];
      send({ type: "door", x, y, closed: !nearest?.closed });
    } else if (fate === "box") send({ type: "box", x, y });
    else if (fate === "person") send({ type: "person", x, y });
  };

  return (
    <div className="side-by-side">
      <figure>
        <figcaption>What it believes</figcaption>
        <PlanCanvas
          testId="believed"
          label={`The drawing as the robot believes it: ${frame?.text ?? "nothing yet"}`}
          bounds={session?.drawing.bounds ?? [0, 0, 1, 1]}
          paint={paintBelieved}
          onPress={(at) => fate === "goal" && onGoal(at)}
          {...startByArrow(fate, send, onPlace, setArrow)}
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
            places={{ "data-robot": truth ? truth.pose.slice(0, 2).join(",") : "", "data-doors": world.doors.map((door) => middle(door.segment)).join(" ") }}
            paint={paintWorld}
            grabs={(at, pixel) => canCarry && !!truth && Math.hypot(at[0] - truth.pose[0], at[1] - truth.pose[1]) < GRAB_PX * pixel}
            onDrag={(_, to, released) => {
              setCarried(released ? null : to);
              if (released) send({ type: "kidnap", x: to[0], y: to[1] });
            }}
            onPress={press}
            cursor={fate === "none" || fate === "goal" ? "grab" : "crosshair"}
          />
        </figure>
      )}
    </div>
  );
}

const middle = ([x1, y1, x2, y2]: Segment) => `${(x1 + x2) / 2},${(y1 + y2) / 2}`;
const middleDistance = ([x1, y1, x2, y2]: Segment, x: number, y: number) => Math.hypot((x1 + x2) / 2 - x, (y1 + y2) / 2 - y);

const ring = ([x, y]: Pose, radius: number): Point[] =>
  Array.from({ length: 24 }, (_, k) => [x + radius * Math.cos((k * Math.PI) / 12), y + radius * Math.sin((k * Math.PI) / 12)]);

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
