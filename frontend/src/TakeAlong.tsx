// What can be kept of a drive: a video that the browser makes, and the files that the server writes.
import { useEffect, useRef, useState } from "react";
import { loadExport } from "./api";
import { saveFile } from "./disk";
import { filmKind, shootFilm } from "./film";
import { clock, percent } from "./numbers";
import type { Session } from "./types";
import type { Drive, Order } from "./useDrive";

interface Kept {
  path: string; // below that of the drive
  file: string;
  text: string;
  of: Session["kind"][];
}

const KEPT: Kept[] = [
  { path: "film", file: "drive.gif", text: "GIF", of: ["drive"] },
  { path: "picture", file: "drive.png", text: "Picture", of: ["drive"] },
  { path: "journal", file: "journal.jsonl", text: "Journal", of: ["drive"] },
  { path: "corrected", file: "corrected.svg", text: "Corrected drawing", of: ["drive", "log", "robot"] },
];

export function TakeAlong({ drive, send }: { drive: Drive; send: (order: Order) => void }) {
  const [share, setShare] = useState<number | null>(null);
  const [writing, setWriting] = useState("");
  const [error, setError] = useState("");
  const stop = useRef(new AbortController());
  const now = useRef(drive);
  now.current = drive;
  useEffect(() => () => stop.current.abort(), []);
  const { session } = drive;
  const kind = filmKind();
  if (!session) return null;

  const shoot = async () => {
    const { frame, recorded, paused } = now.current;
    const isJournal = session.kind === "journal";
    const plans = [...document.querySelectorAll<HTMLCanvasElement>("canvas.plan")];
    if (!kind || plans.length === 0) return;
    stop.current = new AbortController();
    setShare(0);
    if (isJournal) send({ type: "pause", paused: true });
    const film = await shootFilm(plans, kind, {
      span: recorded,
      look: (t) => send({ type: "scrub", t }),
      caption: () => `${clock(now.current.frame?.t ?? 0)}  ${now.current.frame?.text ?? ""}`,
      progress: setShare,
      signal: stop.current.signal,
    });
    send({ type: "scrub", t: isJournal ? (frame?.t ?? 0) : null });
    if (isJournal && !paused) send({ type: "pause", paused: false });
    setShare(null);
    if (film) saveFile(`drive.${kind.slice("video/".length).split(";")[0]}`, film);
  };

  const keep = (what: Kept) => {
    setWriting(what.text);
    setError("");
    loadExport(session.session, what.path)
      .then((content) => saveFile(what.file, content), (problem: unknown) => setError(problem instanceof Error ? problem.message : String(problem)))
      .finally(() => setWriting(""));
  };

  return (
    <div className="row quiet" role="group" aria-label="Take with you">
      Take with you:
      {share === null ? (
        <button disabled={!kind} title={kind ? "" : "this browser makes no videos"} onClick={() => void shoot()}>Video</button>
      ) : (
        <button onClick={() => stop.current.abort()}>Video: {percent(share)}, stop</button>
      )}
      {KEPT.filter((one) => one.of.includes(session.kind)).map((one) => (
        <button key={one.path} disabled={writing !== ""} onClick={() => keep(one)}>{one.text}</button>
      ))}
      <span role="status">{writing && `writing: ${writing} ...`}</span>
      {error && <span className="bad" role="alert">{error}</span>}
    </div>
  );
}
