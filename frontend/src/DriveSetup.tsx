// Before a drive: in which world, from where, how fast; or which recording to watch.
import { useEffect, useState } from "react";
import { listRecordings, listWorlds } from "./api";
import { RECORDINGS, pickFile } from "./disk";
import type { Order } from "./useDrive";
import type { RecordingChoice, WorldChoice } from "./types";

export interface Choice {
  recording: RecordingChoice | null; // watched instead of a drive
  world: string; // "" is this drawing, made real; with a recording, a world that nobody named
  severity: number;
  seed: number;
  speed: number;
  tellStart: boolean;
}

const ROBOT = "robot"; // on the network, among the worlds
export const FIRST_CHOICE: Choice = { recording: null, world: "", severity: 0.3, seed: 1, speed: 2, tellStart: false };
export const SPEEDS = [0.5, 1, 2, 5, 10, 20, 50];

export function orderOf({ recording, world, severity, seed, speed }: Choice): Pick<Order, string> {
  const made = world ? { world } : recording ? {} : { made_real: { severity, seed } };
  return { ...made, ...(recording ? { recording: recording.id } : {}), seed, speed };
}

interface Props {
  choice: Choice;
  setChoice: (choice: Choice) => void;
  hasGoal: boolean;
  hasStart: boolean;
  goals: string[];
  goal: string;
  refusal: string; // why the last drive did not begin
  setGoal: (goal: string) => void;
  watch: (file: File) => void;
  go: () => void;
}

export function DriveSetup({ choice, setChoice, hasGoal, hasStart, goals, goal, refusal, setGoal, watch, go }: Props) {
  const [worlds, setWorlds] = useState<WorldChoice[]>([]);
  const [recordings, setRecordings] = useState<RecordingChoice[]>([]);
  useEffect(() => {
    listWorlds().then(setWorlds, () => setWorlds([]));
    listRecordings().then(setRecordings, () => setRecordings([]));
  }, []);
  const change = (part: Partial<Choice>) => setChoice({ ...choice, ...part });
  const { recording } = choice;
  const isReal = choice.world === ROBOT && !recording;
  const ready = isReal || !!recording || hasGoal || goal !== "";
  const known = recording && !recordings.some((one) => one.id === recording.id) ? [recording, ...recordings] : recordings;
  const chooseWorld = (value: string) => {
    if (value === "file") pickFile(RECORDINGS, watch);
    else if (value.startsWith("watch ")) change({ recording: known.find((one) => `watch ${one.id}` === value) ?? null, world: "" });
    else change({ recording: null, world: value });
  };
  return (
    <form
      className="setup"
      aria-label="Set up a drive"
      onSubmit={(event) => {
        event.preventDefault();
        go();
      }}
    >
      <label>
        {recording ? "Watch" : "World"}
        <select aria-label="World" value={recording ? `watch ${recording.id}` : choice.world} onChange={(event) => chooseWorld(event.target.value)}>
          <optgroup label="Drive in">
            <option value="">this drawing, made real</option>
            {worlds.map((world) => <option key={world.id} value={world.id}>{world.title}</option>)}
          </optgroup>
          <optgroup label="Watch a recording">
            {known.map((one) => <option key={one.id} value={`watch ${one.id}`}>{one.kind} {one.title}</option>)}
            <option value="file">a log or journal of mine ...</option>
          </optgroup>
        </select>
      </label>
      {recording?.kind === "journal" && (
        <label>
          Driven in
          <select aria-label="Driven in" value={choice.world} onChange={(event) => change({ world: event.target.value })}>
            <option value="">a world not known here</option>
            {worlds.filter((world) => world.id !== ROBOT).map((world) => <option key={world.id} value={world.id}>{world.title}</option>)}
          </select>
        </label>
      )}
      {!recording && !choice.world && (
        <label>
          How wrong the drawing is
          <input type="range" min={0} max={1} step={0.05} value={choice.severity} aria-valuetext={severityInWords(choice.severity)} onChange={(event) => change({ severity: Number(event.target.value) })} />
          <span className="quiet">{severityInWords(choice.severity)}</span>
        </label>
      )}
      {!recording && (
        <label>
          Goal
          <select aria-label="Goal" value={goal} onChange={(event) => setGoal(event.target.value)}>
            <option value="">{hasGoal ? "the flag on the drawing" : "choose a room, or set a flag"}</option>
            {goals.map((name) => <option key={name} value={name}>{name}</option>)}
          </select>
        </label>
      )}
      {!isReal && recording?.kind !== "journal" && (
        <label title="another seed is another building, and another try">
          Seed
          <input type="number" min={0} max={99999} value={choice.seed} onChange={(event) => change({ seed: Math.max(0, Math.round(Number(event.target.value))) })} />
        </label>
      )}
      {!isReal && (
        <label>
          Speed
          <select aria-label="Speed" value={choice.speed} onChange={(event) => change({ speed: Number(event.target.value) })}>
            {SPEEDS.map((speed) => <option key={speed} value={speed}>{speed} x</option>)}
          </select>
        </label>
      )}
      {hasStart && !recording && (
        <label className="check">
          <input type="checkbox" checked={choice.tellStart} onChange={(event) => change({ tellStart: event.target.checked })} />
          tell the robot where it starts
        </label>
      )}
      <button className="primary" type="submit" disabled={!ready} data-testid="go">{recording ? "Watch" : isReal ? "Join the robot" : "Go"}</button>
      {isReal && <span className="quiet">Joining moves nothing: it is a dry run until you let the robot drive.</span>}
      {!ready && <span className="quiet">Set a flag with the tool "Goal", or choose a room.</span>}
      {refusal && <span className="bad" role="alert">{refusal}</span>}
    </form>
  );
}

const severityInWords = (severity: number) =>
  severity < 0.1 ? "just as drawn" : severity < 0.4 ? "a good sketch" : severity < 0.75 ? "a quick sketch" : "from poor memory";
