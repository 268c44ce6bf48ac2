// Files of a person's own: picked from the disk, and put there.
export const RECORDINGS = [".log", ".gz", ".clf", ".bag", ".mcap", ".jsonl"];

/** Whether a file is a log or a journal to be watched, by its name. */
export const isRecording = (name: string) => RECORDINGS.some((ending) => name.toLowerCase().endsWith(ending));

/** Lets a person pick a file whose name ends like one of these. */
export function pickFile(endings: string[], then: (file: File) => void): void {
  const input = document.createElement("input");
  input.type = "file";
  input.accept = endings.join(",");
  input.onchange = () => input.files?.[0] && then(input.files[0]);
  input.click();
}

/** Puts a file on the disk. */
export function saveFile(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export const stem = (name: string) => (name.split("/").at(-1) ?? "").replace(/\.[a-z0-9]+$/i, "").replace(/-\d+$/, "") || "drawing";
