// What the server says; docs/reference/table-api.md explains it. Points are [x, y], y down.
export type Point = [number, number];
export type Pose = [number, number, number];
export type Segment = [number, number, number, number];

export interface Stroke {
  points: Point[];
  closed: boolean;
}

export const ZONES = ["keep-out", "slow", "one-way"] as const;
/** Where the robot shall not drive, areas in which it drives slowly, and arrows across doors that it passes only this way. */
export type Zones = Record<(typeof ZONES)[number], Point[][]>;

export interface Upload {
  name: string;
  svg: string;
  strokes: Stroke[];
  labels: { text: string; x: number; y: number }[];
  zones: Zones;
  bounds: [number, number, number, number];
  start: Point | null;
  goal: Point | null;
  furniture: Stroke[];
  metres_per_unit: number | null;
  notes: string[];
}

export interface Cell {
  id: string;
  name: string;
  size: string;
  outline: Point[];
  holes: Point[][];
  center: Point;
  neighbors: { cell: string; gateway: string }[];
}

export interface Mend {
  kind: "cut" | "close";
  text: string;
  segment: [Point, Point];
}

export interface Finding {
  kind: string;
  severity: "error" | "warning" | "note";
  text: string;
  where: Point | null;
  mend: Mend | null;
}

export interface Understanding {
  ms: number;
  bounds: [number, number, number, number];
  cells: Cell[];
  gateways: { id: string; cells: [string, string]; segment: [Point, Point] }[];
  labels: { text: string; x: number; y: number; cell: string }[];
  zones: Zones;
  start: Point | null;
  goal: Point | null;
  findings: Finding[];
  route: { cells: string[]; way: Point[]; cost: number } | null;
}

export interface World {
  bounds: [number, number, number, number];
  walls: Segment[];
  glass: Segment[];
  boxes: Segment[];
  doors: { segment: Segment; closed: boolean }[];
  goal: Point | null;
}

export interface PlaceBelief {
  place: string;
  cell: string;
  pose: Pose;
  probability: number;
}

export interface Frame {
  t: number;
  live: boolean;
  text: string;
  believed: {
    status: "located" | "lost" | "mismatch";
    place: string;
    cell: string;
    probability: number;
    fit: number;
    pose: Pose;
    scale: number;
    places: PlaceBelief[];
    particles: number[];
    scan: number[];
    behavior: string;
    route: Point[];
    gateway: [Point, Point] | null;
    distance: number | null;
  };
  speed: [number, number];
  world: {
    pose: Pose;
    scan: number[];
    people: Point[];
    doors: Segment[];
    on_drawing: Pose | null;
    collisions: number;
  } | null;
}

/** The drawing as the robot has found it until now, laid over the drawn one. */
export interface Corrected {
  t: number;
  seen: Point[][];
  unseen: Point[][];
  passages: { gateway: string; segment: [Point, Point]; state: "open" | "closed" | "unseen" }[];
  seen_share: number;
}

export interface Mark {
  t: number;
  kind: string;
  text: string;
}

/** A point of the way that a robot drove. */
export interface WayPoint {
  t: number;
  believed: Point;
  true: Point | null;
  sure: boolean;
}

export interface Session {
  session: string;
  kind: "drive" | "log" | "journal" | "robot";
  title: string;
  drawing: { bounds: [number, number, number, number]; strokes: Stroke[]; labels: Upload["labels"]; zones: Zones; goal: Point | null };
  way?: WayPoint[]; // of a journal
  speed: number;
  paused: boolean;
  over: boolean;
}

/** How it is with a robot on the network. */
export interface RobotState {
  can_drive: boolean;
  drives: boolean;
  trouble: string; // why it must stand
  goal: string;
}

export interface WorldChoice {
  id: string;
  title: string;
  drawings: string[];
}

export interface RecordingChoice {
  id: string;
  title: string;
  kind: "log" | "journal";
}
