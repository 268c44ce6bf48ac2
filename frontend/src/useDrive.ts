// One drive over a websocket: what the server told last, and how to tell it something. Reconnects and resumes by itself.
import { useCallback, useEffect, useRef, useState } from "react";
import type { Corrected, Frame, Mark, RobotState, Session, World } from "./types";

const REFUSAL_MS = 8000; // that it is told why something cannot be done
const RETRY_MS = [300, 1000, 2000, 5000];

export interface Drive {
  session: Session | null;
  world: World | null;
  corrected: Corrected | null;
  frame: Frame | null;
  marks: Mark[];
  paused: boolean;
  speed: number;
  recorded: [number, number];
  done: { outcome: string; text: string } | null;
  error: string;
  fatal: boolean;
  connected: boolean;
  robot: RobotState | null; // of a robot on the network
  commands: boolean; // whether this page commands it
}

const NONE: Drive = {
  session: null, world: null, corrected: null, frame: null, marks: [], paused: false, speed: 1, recorded: [0, 0],
  done: null, error: "", fatal: false, connected: false, robot: null, commands: false,
};

export type Order = { type: string } & Record<string, unknown>;

function say(line: WebSocket, order: Order): void {
  if (line.readyState === WebSocket.OPEN) line.send(JSON.stringify({ v: 1, ...order }));
}

export function useDrive(): {
  drive: Drive | null;
  begin: (order: Order) => void;
  resume: (session: string) => void;
  /** The same drive from its beginning, by what was ordered then. */
  restart: (session: string, speed: number) => void;
  send: (order: Order) => void;
  leave: () => void;
} {
  const [drive, setDrive] = useState<Drive | null>(null);
  const socket = useRef<WebSocket | null>(null);
  const session = useRef("");
  const tries = useRef(0);

  const open = useCallback((first: Order) => {
    const address = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/live`;
    const line = new WebSocket(address);
    socket.current?.close();
    socket.current = line;
    line.onopen = () => say(line, first);
    line.onmessage = (event) => {
      if (socket.current !== line) return;
      const message = JSON.parse(event.data as string);
      if (message.type === "session") {
        session.current = message.session;
        tries.current = 0;
      }
      if (message.type === "error" && message.fatal) session.current = "";
      setDrive((before) => heard(before ?? NONE, message));
      if (message.type === "error" && !message.fatal) setTimeout(() => setDrive((before) => withoutError(before, message.text)), REFUSAL_MS);
      if (message.type === "frame") requestAnimationFrame(() => say(line, { type: "seen" }));
    };
    line.onclose = () => {
      if (socket.current !== line) return;
      setDrive((before) => before && { ...before, connected: false });
      if (!session.current) {
        setDrive((before) => before && { ...before, fatal: true, error: before.error || "the drive could not be reached" });
        return;
      }
      const wait = RETRY_MS[Math.min(tries.current++, RETRY_MS.length - 1)];
      setTimeout(() => {
        if (socket.current === line && session.current) open({ type: "resume", session: session.current });
      }, wait);
    };
  }, []);

  const begin = useCallback((order: Order) => {
    session.current = "";
    setDrive(NONE);
    open(order);
  }, [open]);
  const resume = useCallback((id: string) => {
    session.current = id;
    setDrive(NONE);
    open({ type: "resume", session: id });
  }, [open]);
  const send = useCallback((order: Order) => {
    if (socket.current) say(socket.current, order);
  }, []);
  // A drive that is left for good ends, unless somebody else watches it; one that is reloaded goes on.
  const leave = useCallback(() => {
    session.current = "";
    const line = socket.current;
    socket.current = null;
    if (line) say(line, { type: "leave" });
    line?.close();
    setDrive(null);
  }, []);
  const restart = useCallback((id: string, speed: number) => {
    send({ type: "leave" });
    begin({ type: "restart", session: id, speed });
  }, [begin, send]);

  useEffect(() => () => socket.current?.close(), []);
  return { drive, begin, resume, restart, send, leave };
}

/** A drive of which it is no longer told why something could not be done. */
const withoutError = (drive: Drive | null, text: string) => (drive && drive.error === text && !drive.fatal ? { ...drive, error: "" } : drive);

/** A drive after one more message of the server; unknown ones change nothing. */
function heard(drive: Drive, message: Record<string, unknown> & { type: string }): Drive {
  switch (message.type) {
    case "session": {
      const told = message as unknown as Session;
      return { ...drive, session: told, paused: told.paused, speed: told.speed, connected: true, error: "", fatal: false };
    }
    case "world":
      return { ...drive, world: message as unknown as World };
    case "corrected":
      return { ...drive, corrected: message as unknown as Corrected };
    case "frame":
      return { ...drive, frame: message as unknown as Frame };
    case "marks":
      return { ...drive, marks: message.marks as Mark[] };
    case "state":
      return {
        ...drive,
        paused: message.paused as boolean,
        speed: message.speed as number,
        done: message.over ? drive.done : null,
        robot: (message.robot as RobotState | undefined) ?? null,
        recorded: (message.recorded as [number, number] | null) ?? drive.recorded,
      };
    case "command":
      return { ...drive, commands: message.holds === true };
    case "done":
      return { ...drive, done: { outcome: message.outcome as string, text: message.text as string } };
    case "error":
      return { ...drive, error: message.text as string, fatal: drive.fatal || message.fatal === true };
    default:
      return drive;
  }
}
