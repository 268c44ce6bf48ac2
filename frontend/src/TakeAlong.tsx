// What can be kept of a drive: a video that the browser makes, and the files that the server writes.
import { useEffect, useRef, useState } from "react";
import { saveFile } from "./disk";
import { filmKind, shootFilm } from "./film";
import { clock, percent } from "./numbers";
import type { Drive, Order } from "./useDrive";

export function TakeAlong({ drive, send }: { drive: Drive; send: (order: Order) => void }) {
  const [share, setShare] = useState<number | null>(null);
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

  return (
    <div className="row quiet" role="group" aria-label="Take with you">
      Take with you:
      {share === null ? (
        <button disabled={!kind} title={kind ? "" : "this browser makes no videos"} onClick={() => void shoot()}>Video</button>
      ) : (
        <button onClick={() => stop.current.abort()}>Video: {percent(share)}, stop</button>
      )}
      {session.kind === "drive" && (
        <>
          <a href={`/api/sessions/${session.session}/film`} download="drive.gif">GIF</a>
          <a href={`/api/sessions/${session.session}/picture`} download="drive.png">picture</a>
          <a href={`/api/sessions/${session.session}/journal`} download="journal.jsonl">journal</a>
        </>
      )}
    </div>
  );
}
