// What is laid on the sheet: a drawing of the folder, an example, a file of one's own, or nothing.
import { useCallback, useRef } from "react";
import { loadDrawing, loadExample, SVG } from "./api";
import { isRecording, stem } from "./disk";
import type { Opening } from "./Files";
import { openContent } from "./opening";
import type { Scene } from "./svg";
import type { Autosave } from "./useAutosave";

/** A drawing as the server knows it. */
export type Origin = { drawing: string } | { content: { media: string; text: string } };

interface Sheet {
  save: Autosave;
  whole: () => string; // the present drawing as text
  show: (scene: Scene) => void;
  tell: (text: string, stays?: boolean) => void;
  watch: (file: File) => void;
  leave: () => void; // the drive that is shown in place of the sheet
  begin: () => void; // drawing on an empty sheet
}

export function useOpening({ save, whole, show, tell, watch, leave, begin }: Sheet): {
  opening: Opening;
  openNamed: (name: string) => Promise<void>;
  guarded: (action: () => Promise<void>) => void;
  /** The file that the drawing comes from, in whose units its journals are; null if the table drew it. */
  origin: () => Origin | null;
} {
  const from = useRef<Origin | null>(null);

  const openBlob = useCallback(async (name: string, content: Blob, title: string, origin?: Origin) => {
    tell(`reading ${title} ...`, true);
    const opened = await openContent(name, content);
    leave();
    show(opened);
    from.current = opened.svg === null ? null : (origin ?? { content: { media: SVG, text: opened.svg } });
    save.adopt({ name: "", base: stem(title), tag: null }, whole());
    tell(opened.notes.join("; "));
  }, [save, show, tell, leave, whole]);

  const openNamed = useCallback(async (name: string, isOpened = () => {}) => {
    tell(`reading ${name} ...`, true);
    const { text, tag } = await loadDrawing(name);
    const opened = await openContent(name.split("/").at(-1)!, new Blob([text], { type: "text/plain" }), name);
    isOpened();
    show(opened);
    const own = text.includes("drawing-table-scene");
    from.current = own ? null : { drawing: name };
    save.adopt(own ? { name, base: stem(name), tag } : { name: "", base: stem(name), tag: null }, whole());
    tell(own ? "" : `${name} stays as it is; what you change is saved as a copy`);
  }, [save, show, tell, whole]);

  const guarded = useCallback((action: () => Promise<void>) => {
    save.saveNow().then((isSaved) => {
      if (!isSaved) throw new Error("this drawing cannot be saved just now, so nothing else is opened");
      return action();
    }).catch((problem: unknown) => tell(problem instanceof Error ? problem.message : String(problem)));
  }, [save, tell]);

  const opening: Opening = {
    openDrawing: (name) => guarded(() => openNamed(name, leave)),
    openExample: (name) => guarded(async () => openBlob("example.svg", new Blob([await loadExample(name)], { type: SVG }), name, { drawing: `example:${name}` })),
    openFile: (file) => (isRecording(file.name) ? watch(file) : guarded(async () => openBlob(file.name, file, file.name, await originOf(file)))),
    openEmpty: () => guarded(async () => {
      leave();
      show({ elements: [], files: {} });
      from.current = null;
      save.adopt({ name: "", base: "drawing", tag: null }, whole());
      begin();
    }),
  };
  return { opening, openNamed, guarded, origin: useCallback(() => from.current, []) };
}

/** An SVG file is its own origin; of others it is what the server made of them. */
async function originOf(file: File): Promise<Origin | undefined> {
  return /\.svg$/i.test(file.name) ? { content: { media: SVG, text: await file.text() } } : undefined;
}
