// Requests to the server. Every refusal is an ApiError with one sentence that a person can read.
import type { RecordingChoice, Understanding, Upload, WorldChoice } from "./types";

export const SVG = "image/svg+xml";

export class ApiError extends Error {
  constructor(
    message: string,
    readonly status: number,
  ) {
    super(message);
  }
}

async function ask(path: string, init?: RequestInit): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(path, init);
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new ApiError("the server does not answer", 0);
  }
  if (answer.ok) return answer;
  const told = (await answer.json().catch(() => null)) as { error?: string } | null;
  throw new ApiError(told?.error ?? `the server answers ${answer.status}`, answer.status);
}

function path(name: string): string {
  const parts = name.split("/");
  if (parts.includes("..") || parts.includes(".")) throw new ApiError("a name must stay in the folder", 400); // an address cannot hold these
  return parts.map(encodeURIComponent).join("/");
}

const tagOf = (answer: Response) => (answer.headers.get("ETag") ?? "").replaceAll('"', "");

export interface Listed {
  name: string;
  title?: string;
  modified?: number;
}

export async function listDrawings(): Promise<Listed[]> {
  return (await (await ask("/api/drawings")).json()).drawings;
}

export async function listExamples(): Promise<Listed[]> {
  return (await (await ask("/api/examples")).json()).examples;
}

export async function listWorlds(): Promise<WorldChoice[]> {
  return (await (await ask("/api/worlds")).json()).worlds;
}

export async function listRecordings(): Promise<RecordingChoice[]> {
  return (await (await ask("/api/recordings")).json()).recordings;
}

export async function sendRecording(file: File): Promise<RecordingChoice> {
  const answer = await ask(`/api/recordings?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
  return answer.json();
}

export async function loadDrawing(name: string): Promise<{ text: string; tag: string }> {
  const answer = await ask(`/api/drawings/${path(name)}`);
  return { text: await answer.text(), tag: tagOf(answer) };
}

export async function loadExample(name: string): Promise<string> {
  return (await ask(`/api/examples/${path(name)}`)).text();
}

/** What the server writes of a drive. */
export async function loadExport(session: string, what: string): Promise<Blob> {
  return (await ask(`/api/sessions/${session}/${what}`)).blob();
}

/** Saves a drawing; `tag` is the version it replaces, null if it must be new. Returns the new tag. */
export async function saveDrawing(name: string, text: string, tag: string | null, leaving = false): Promise<string> {
  const condition: Record<string, string> = tag === null ? { "If-None-Match": "*" } : { "If-Match": `"${tag}"` };
  const answer = await ask(`/api/drawings/${path(name)}`, {
    method: "PUT",
    body: text,
    headers: { "Content-Type": SVG, ...condition },
    keepalive: leaving && text.length < 60_000,
  });
  return (await answer.json()).tag;
}

/** Has a file read; `drawing` is its name in the folder if it is there: the table beside it is read, too. */
export async function upload(name: string, content: Blob, drawing = ""): Promise<Upload> {
  const query = new URLSearchParams({ name, ...(drawing ? { drawing } : {}) });
  const answer = await ask(`/api/uploads?${query}`, { method: "POST", body: content });
  return answer.json();
}

/** Asks what is understood of a drawing; `drawing` is its name in the folder, "" as long as it has none. */
export async function understand(svg: string, drawing: string, signal: AbortSignal, ends?: [string, string]): Promise<Understanding> {
  const query = new URLSearchParams({ ...(drawing ? { drawing } : {}), ...(ends ? { from: ends[0], to: ends[1] } : {}) });
  const answer = await ask(`/api/understand?${query}`, {
    method: "POST",
    body: svg,
    headers: { "Content-Type": SVG },
    signal,
  });
  return answer.json();
}
