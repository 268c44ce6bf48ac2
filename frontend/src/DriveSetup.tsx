// Before a drive: in which world, from where, how fast.
import { useEffect, useState } from "react";
import { listWorlds } from "./api";
import type { Order } from "./useDrive";
import type { WorldChoice } from "./types";

export interface Choice {
  world: string; // "" is this drawing, made real
  severity: number;
  seed: number;
  speed: number;
  tellStart: boolean;
}

export const FIRST_CHOICE: Choice = { world: "", severity: 0.3, seed: 1, speed: 2, tellStart: false };

export function orderOf(choice: Choice): Pick<Order, string> {
  const world = choice.world ? { world: choice.world } : { made_real: { severity: choice.severity, seed: choice.seed } };
  return { ...world, seed: choice.seed, speed: choice.speed };
}

interface Props {
  choice: Choice;
  setChoice: (choice: Choice) => void;
  hasGoal: boolean;
  hasStart: boolean;
  goals: string[];
  goal: string;
  setGoal: (goal: string) => void;
  go: () => void;
}

export function DriveSetup({ choice, setChoice, hasGoal, hasStart, goals, goal, setGoal, go }: Props) {
  const [worlds, setWorlds] = useState<WorldChoice[]>([]);
  useEffect(() => {
    listWorlds().then(setWorlds, () => setWorlds([]));
  }, []);
  const change = (part: Partial<Choice>) => setChoice({ ...choice, ...part });
  const ready = hasGoal || goal !== "";
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
        World
        <select aria-label="World" value={choice.world} onChange={(event) => change({ world: event.target.value })}>
          <option value="">this drawing, made real</option>
          {worlds.map((world) => <option key={world.id} value={world.id}>{world.title}</option>)}
        </select>
      </label>
      {!choice.world && (
        <label>
          How wrong the drawing is
          <input type="range" min={0} max={1} step={0.05} value={choice.severity} aria-valuetext={severityInWords(choice.severity)} onChange={(event) => change({ severity: Number(event.target.value) })} />
          <span className="quiet">{severityInWords(choice.severity)}</span>
        </label>
      )}
      <label>
        Goal
        <select aria-label="Goal" value={goal} onChange={(event) => setGoal(event.target.value)}>
          <option value="">{hasGoal ? "the flag on the drawing" : "choose a room, or set a flag"}</option>
          {goals.map((name) => <option key={name} value={name}>{name}</option>)}
        </select>
      </label>
      <label>
        Seed
        <input type="number" min={0} max={99999} value={choice.seed} onChange={(event) => change({ seed: Math.max(0, Math.round(Number(event.target.value))) })} />
      </label>
      <label>
        Speed
        <select aria-label="Speed" value={choice.speed} onChange={(event) => change({ speed: Number(event.target.value) })}>
          {[1, 2, 5, 10, 20].map((speed) => <option key={speed} value={speed}>{speed} x</option>)}
        </select>
      </label>
      {hasStart && (
        <label className="check">
          <input type="checkbox" checked={choice.tellStart} onChange={(event) => change({ tellStart: event.target.checked })} />
          tell the robot where it starts
        </label>
      )}
      <button className="primary" type="submit" disabled={!ready} data-testid="go">Go</button>
      {!ready && <span className="quiet">Set a flag with the tool "Goal", or choose a room.</span>}
    </form>
  );
}

const severityInWords = (severity: number) =>
  severity < 0.1 ? "just as drawn" : severity < 0.4 ? "a good sketch" : severity < 0.75 ? "a quick sketch" : "from poor memory";
