// Asks the server what it understands of the drawing, shortly after each change; a later question ends an earlier one.
import { useEffect, useState } from "react";
import { ApiError, understand } from "./api";
import type { Point, Understanding } from "./types";

const PAUSE_MS = 100; // without a change, before the server is asked: a pen that is drawn moves more often

export interface Understood {
  told: Understanding | null;
  error: string;
}

export function useUnderstanding(content: () => string, name: string, revision: number, ends: [Point, Point] | null): Understood {
  const [understood, setUnderstood] = useState<Understood>({ told: null, error: "" });
  useEffect(() => {
    if (revision === 0) return;
    const control = new AbortController();
    const timer = setTimeout(() => {
      const places = ends?.map((p) => p.map((v) => v.toFixed(2)).join(",")) as [string, string] | undefined;
      understand(content(), name, control.signal, places)
        .then((told) => {
          setUnderstood({ told, error: "" });
          requestAnimationFrame(() => remark("cells-shown"));
        })
        .catch((error: unknown) => {
          if (control.signal.aborted) return;
          setUnderstood((before) => ({ ...before, error: error instanceof ApiError ? error.message : String(error) }));
        });
    }, PAUSE_MS);
    return () => {
      clearTimeout(timer);
      control.abort();
    };
  }, [content, name, revision, ends]);
  return understood;
}

/** Marks the moment at which something happened last, for who measures the page. */
export function remark(name: string): void {
  performance.clearMarks(name);
  performance.mark(name);
}
