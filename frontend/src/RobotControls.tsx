// Below a robot on the network: stop, always; let it drive, by a button that says so; what it hears and believes, in words.
import { useEffect } from "react";
import { Timeline } from "./DriveControls";
import type { Fate } from "./fate";
import { clock, percent } from "./numbers";
import { TakeAlong } from "./TakeAlong";
import type { Drive, Order } from "./useDrive";

const ALIVE_MS = 250; // how often the page says that it is there; a robot whose page falls silent stands

interface Props {
  drive: Drive;
  fate: Fate;
  setFate: (fate: Fate) => void;
  send: (order: Order) => void;
  leave: () => void;
}

export function RobotControls({ drive, fate, setFate, send, leave }: Props) {
  const { frame, session, robot, commands, connected } = drive;
  const believed = frame?.believed;
  const drives = !!robot?.drives;
  usePresence(commands && connected, send);

  const whyNot = !connected ? "the connection to the table is lost"
    : !commands ? "another page commands this robot; here you can watch, and stop it"
    : !robot?.can_drive ? "the table was not started with --drive"
    : !robot.goal ? "choose a goal first"
    : "";
  const names = [...new Set((session?.drawing.labels ?? []).map((label) => label.text))].sort();
  const choose = (wanted: Fate) => setFate(fate === wanted ? "none" : wanted);
  const hint = fate === "goal" ? "click a place on the drawing" : fate === "start" ? "drag on the drawing from where it stands to where it looks" : "";

  return (
    <section className="drive-controls robot" aria-label="The robot on the network">
      <button className="stop" data-testid="stop" title="Escape stops it too" onClick={() => send({ type: "stop" })}>STOP</button>
      <div className="robot-words">
        <p className={`status ${believed?.status ?? ""}`} role="status" data-testid="status">
          <b>{frame?.text ?? (drive.error ? "" : "nothing is heard of the robot yet")}</b>
          {robot?.trouble && <span className="bad" data-testid="trouble"> standing: {robot.trouble}</span>}
          {!connected && session && !drive.fatal && <span className="bad"> connection lost: the robot stands, trying again</span>}
          {drive.error && <span className="bad"> {drive.error}</span>}
        </p>
        <p className={drives ? "bad" : "quiet"} data-testid="mode">
          {drives ? `The real robot drives to ${robot?.goal}. Keep this page in view: hidden or closed, it stops the robot.` : "Dry run: no command is sent, this page moves nothing."}
        </p>
        {believed && (
          <dl className="figures">
            <div><dt>time</dt><dd>{clock(frame.t)}</dd></div>
            <div><dt>sure</dt><dd data-testid="probability">{percent(believed.probability)}</dd></div>
            <div><dt>fit</dt><dd>{percent(believed.fit)}</dd></div>
            <div><dt>{drives ? "speed" : "would drive"}</dt><dd>{frame.speed[0].toFixed(2)} m/s</dd></div>
            <div><dt>to go</dt><dd>{believed.distance == null ? "?" : `${believed.distance.toFixed(0)} m`}</dd></div>
            <div className="wide"><dt>places</dt><dd>{believed.places.slice(0, 3).map((one) => `${one.place || one.cell} ${percent(one.probability)}`).join(", ") || "none"}</dd></div>
          </dl>
        )}
        <div className="row" role="group" aria-label="Command">
          <button className="primary" disabled={drives || !!whyNot} data-testid="let-drive" onClick={() => send({ type: "drive" })}>
            {robot?.goal ? `Let the real robot drive to ${robot.goal}` : "Let the real robot drive"}
          </button>
          {whyNot && <span className="quiet" data-testid="why-not">{whyNot}</span>}
        </div>
        <div className="row" role="group" aria-label="Goal and start">
          <label>
            Goal
            <select aria-label="Goal" disabled={!commands} value={names.includes(robot?.goal ?? "") ? robot!.goal : ""} onChange={(event) => event.target.value && send({ type: "goal", goal: event.target.value })}>
              <option value="">{robot?.goal ? "a place on the drawing" : "choose a room"}</option>
              {names.map((name) => <option key={name} value={name}>{name}</option>)}
            </select>
          </label>
          <button disabled={!commands} aria-pressed={fate === "goal"} onClick={() => choose("goal")}>Goal by click</button>
          <button disabled={!commands} aria-pressed={fate === "start"} onClick={() => choose("start")}>It stands here</button>
          <span className="quiet">{hint}</span>
          <button onClick={leave}>Back to the drawing</button>
        </div>
        <div className="row quiet" role="group" aria-label="For simulated worlds only">
          {["Pause", "Step", "Speed", "Door", "Box", "Person"].map((name) => <button key={name} disabled>{name}</button>)}
          <span>for simulated worlds only: this robot is real, and its time goes on by itself</span>
        </div>
      </div>
      <Timeline drive={drive} send={send} />
      <TakeAlong drive={drive} send={send} />
    </section>
  );
}

/** Says again and again that the page is there, while it can be seen; Escape stops the robot. */
function usePresence(commands: boolean, send: (order: Order) => void): void {
  useEffect(() => {
    const stop = (event: KeyboardEvent) => event.key === "Escape" && send({ type: "stop" });
    window.addEventListener("keydown", stop);
    return () => window.removeEventListener("keydown", stop);
  }, [send]);
  useEffect(() => {
    if (!commands) return;
    const timer = setInterval(() => !document.hidden && send({ type: "alive" }), ALIVE_MS);
    return () => clearInterval(timer);
  }, [commands, send]);
}
