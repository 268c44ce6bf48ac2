// Below a drive: what it is about in words, pause and speed, the fate that one may play, and the timeline.
import { SPEEDS } from "./DriveSetup";
import { FATES, type Fate } from "./fate";
import { clock, percent } from "./numbers";
import { TakeAlong } from "./TakeAlong";
import type { Drive, Order } from "./useDrive";

const MARK_COLOR: Record<string, string> = {
  found: "#4f9d69", reached: "#4f9d69", lost: "#d1495b", mismatch: "#d1495b", "gave up": "#d1495b", blocked: "#8c4a2f", fate: "#7b6ca8",
};

interface Props {
  drive: Drive;
  fate: Fate;
  setFate: (fate: Fate) => void;
  send: (order: Order) => void;
  restart: () => void;
  leave: () => void;
}

export function DriveControls({ drive, fate, setFate, send, restart, leave }: Props) {
  const { frame, done, session, paused } = drive;
  const believed = frame?.believed;
  const isDrive = session?.kind === "drive";
  const hint = FATES.find((one) => one.fate === fate && (fate === "goal" || !done))?.hint ?? (isDrive && !done ? "drag the robot in the world to carry it elsewhere" : "");
  return (
    <section className="drive-controls" aria-label="Drive">
      <p className={`status ${believed?.status ?? ""}`} role="status" data-testid="status" data-outcome={done?.outcome ?? ""}>
        <b>{done && frame?.live !== false ? done.text || done.outcome : (frame?.text ?? (drive.error ? "" : "the robot wakes up ..."))}</b>
        {!drive.connected && session && !drive.fatal && <span className="bad"> connection lost, trying again</span>}
        {drive.error && <span className="bad"> {drive.error}</span>}
      </p>
      {believed && (
        <dl className="figures">
          <div><dt>time</dt><dd>{clock(frame.t)}</dd></div>
          <div><dt>sure</dt><dd data-testid="probability">{percent(believed.probability)}</dd></div>
          <div><dt>fit</dt><dd>{percent(believed.fit)}</dd></div>
          {session?.kind !== "log" && <div><dt>speed</dt><dd>{frame.speed[0].toFixed(2)} m/s</dd></div>}
          {session?.kind !== "log" && <div><dt>to go</dt><dd>{believed.distance == null ? "?" : `${believed.distance.toFixed(0)} m`}</dd></div>}
          <div className="wide"><dt>places</dt><dd>{believed.places.slice(0, 3).map((one) => `${one.place || one.cell} ${percent(one.probability)}`).join(", ") || "none"}</dd></div>
        </dl>
      )}
      <div className="row" role="group" aria-label="Course of the drive">
        <button className="primary" disabled={!!done} onClick={() => send({ type: "pause", paused: !paused })}>{paused ? "Go on" : "Pause"}</button>
        <button disabled={!!done} onClick={() => send({ type: "step" })}>Step</button>
        <label>
          Speed
          <select value={SPEEDS.includes(drive.speed) ? drive.speed : 1} onChange={(event) => send({ type: "speed", speed: Number(event.target.value) })}>
            {SPEEDS.map((speed) => <option key={speed} value={speed}>{speed} x</option>)}
          </select>
        </label>
        <button onClick={restart}>Restart</button>
        <button onClick={leave}>Back to the drawing</button>
      </div>
      {isDrive && (
        <div className="row" role="group" aria-label="Play fate">
          <span className="quiet">Play fate:</span>
          {FATES.filter((one) => one.fate === "goal" || !done).map((one) => (
            <button key={one.fate} aria-pressed={fate === one.fate} onClick={() => setFate(fate === one.fate ? "none" : one.fate)}>{one.text}</button>
          ))}
          <span className="quiet">{hint}</span>
        </div>
      )}
      <Timeline drive={drive} send={send} />
      <TakeAlong drive={drive} send={send} />
    </section>
  );
}

export function Timeline({ drive, send }: { drive: Drive; send: (order: Order) => void }) {
  const [first, last] = drive.recorded;
  const end = Math.max(last, drive.frame?.live ? drive.frame.t : 0, 1);
  const now = drive.frame?.t ?? 0;
  const at = (t: number) => `${(100 * (t - first)) / Math.max(end - first, 1e-6)}%`;
  return (
    <div className="timeline">
      <div className="marks" aria-hidden="true">
        {drive.marks.map((mark, k) => (
          <i key={k} className="mark" style={{ left: at(mark.t), background: MARK_COLOR[mark.kind] ?? "#8b939e" }} title={`${clock(mark.t)} ${mark.text}`} />
        ))}
      </div>
      <input
        type="range" min={first} max={end} step={0.1} value={Math.min(now, end)}
        aria-label="Timeline: look back at any moment" aria-valuetext={clock(now)} data-testid="timeline"
        onChange={(event) => send({ type: "scrub", t: Number(event.target.value) })}
      />
      <button disabled={drive.frame?.live !== false} hidden={drive.session?.kind === "journal"} onClick={() => send({ type: "scrub", t: null })}>Now</button>
      <ol className="log" aria-label="What happened" data-testid="marks">
        {drive.marks.slice(-4).map((mark, k) => (
          <li key={k}><span>{clock(mark.t)}</span> {mark.text || mark.kind}</li>
        ))}
      </ol>
    </div>
  );
}
