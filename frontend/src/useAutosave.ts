// Saves the drawing a moment after each change, each time as the successor of the version last seen.
import { useCallback, useEffect, useRef, useState } from "react";
import { ApiError, listDrawings, saveDrawing } from "./api";

const PAUSE_MS = 700; // without a change, before it is saved
const LONGEST_MS = 1500; // that a change waits while one draws on
const RETRY_MS = 2000; // after a save that failed

export interface Document {
  name: string; // "" as long as it is not saved
  base: string; // what its name begins with when it gets one
  tag: string | null; // version that the server has; null while it has none
}

export type SaveState = "saved" | "saving" | "conflict" | "failed";

export interface Autosave {
  document: Document;
  state: SaveState;
  error: string;
  /** Save what is not saved yet; tells whether all is. */
  saveNow: () => Promise<boolean>;
  /** Go on with another document; `saved` is its content as the server has it, null to save it at once. */
  adopt: (document: Document, saved: string | null) => void;
}

export function useAutosave(content: () => string, revision: number): Autosave {
  const [document, setDocument] = useState<Document>({ name: "", base: "drawing", tag: null });
  const [state, setState] = useState<SaveState>("saved");
  const [error, setError] = useState("");
  const [attempt, setAttempt] = useState(0);
  const now = useRef({ document, saved: "", changedAt: 0 });
  const turn = useRef<Promise<boolean>>(Promise.resolve(true));

  const saveNow = useCallback(() => {
    turn.current = turn.current.then(async () => {
      const { document } = now.current;
      const text = content();
      now.current.changedAt = 0;
      if (text === now.current.saved) {
        setState((before) => (before === "conflict" ? before : "saved"));
        return true;
      }
      setState("saving");
      try {
        const name = document.name || (await freeName(document.base));
        const tag = await saveDrawing(name, text, document.tag);
        if (now.current.document !== document) return true;
        now.current.saved = text;
        now.current.document = { ...document, name, tag };
        setDocument(now.current.document);
        setError("");
        setState(now.current.changedAt ? "saving" : "saved"); // a change may have come meanwhile
        return true;
      } catch (problem) {
        setError(problem instanceof Error ? problem.message : String(problem));
        const refused = problem instanceof ApiError && (problem.status === 409 || problem.status === 412);
        setState(refused ? "conflict" : "failed");
        if (!refused) setTimeout(() => setAttempt((before) => before + 1), RETRY_MS);
        return false;
      }
    });
    return turn.current;
  }, [content]);

  const adopt = useCallback((document: Document, saved: string | null) => {
    now.current = { document, saved: saved ?? "", changedAt: 0 };
    setDocument(document);
    setError("");
    setState("saved");
    if (saved === null) void saveNow();
  }, [saveNow]);

  const isStopped = state === "conflict";
  useEffect(() => {
    if (revision === 0 || isStopped) return;
    now.current.changedAt ||= performance.now();
    setState((before) => (before === "saved" ? "saving" : before));
    const waited = performance.now() - now.current.changedAt;
    const timer = setTimeout(() => void saveNow(), Math.max(0, Math.min(PAUSE_MS, LONGEST_MS - waited)));
    return () => clearTimeout(timer);
  }, [revision, isStopped, attempt, saveNow]);

  useEffect(() => {
    const leave = () => {
      const { document, saved } = now.current;
      const text = content();
      if (document.name && text !== saved) void saveDrawing(document.name, text, document.tag, true).catch(() => {});
    };
    window.addEventListener("pagehide", leave);
    return () => window.removeEventListener("pagehide", leave);
  }, [content]);

  return { document, state, error, saveNow, adopt };
}

async function freeName(base: string): Promise<string> {
  const taken = (await listDrawings()).map((one) => one.name.toLowerCase()); // some disks do not tell large letters from small ones
  for (let k = 1; k < 1000; k++) {
    const name = `${base}${k > 1 ? `-${k}` : ""}.svg`;
    if (!taken.includes(name.toLowerCase())) return name;
  }
  throw new ApiError(`there are too many drawings called ${base}`, 0);
}
