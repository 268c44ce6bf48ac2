// Opening and saving: drawings of the folder, examples, files of one's own, and the name of the present one.
import { useEffect, useRef, useState } from "react";
import { listDrawings, listExamples, type Listed } from "./api";

interface Lists {
  drawings: Listed[];
  examples: Listed[];
}

export interface Opening {
  openDrawing: (name: string) => void;
  openExample: (name: string) => void;
  openFile: (file: File) => void;
  openEmpty: () => void;
}

function useLists(asked: boolean): Lists {
  const [lists, setLists] = useState<Lists>({ drawings: [], examples: [] });
  useEffect(() => {
    if (!asked) return;
    void Promise.all([listDrawings().catch(() => []), listExamples().catch(() => [])]).then(([drawings, examples]) =>
      setLists({ drawings: drawings.sort((a, b) => (b.modified ?? 0) - (a.modified ?? 0)), examples }),
    );
  }, [asked]);
  return lists;
}

const exampleAddress = (name: string) => `/api/examples/${name.split("/").map(encodeURIComponent).join("/")}`;

/** What a new page shows: an invitation to draw, and examples to begin with. */
export function Welcome({ opening, close }: { opening: Opening; close: () => void }) {
  const { drawings, examples } = useLists(true);
  return (
    <section className="card welcome" aria-label="Begin">
      <h2>Draw a building, mark a goal, and watch a robot find its way.</h2>
      <p>Draw walls with the pen, lines or boxes. Leave gaps for doors, or cut them with the door tool. Or begin with one of these:</p>
      <ul className="examples">
        <li><button onClick={() => { opening.openEmpty(); close(); }}><span className="sheet" aria-hidden="true">+</span>empty sheet</button></li>
        {examples.slice(0, 6).map((one) => (
          <li key={one.name}>
            <button onClick={() => { opening.openExample(one.name); close(); }}><img src={exampleAddress(one.name)} alt="" />{one.title ?? one.name}</button>
          </li>
        ))}
      </ul>
      {drawings.length > 0 && (
        <p className="recent">
          Go on with:{" "}
          {drawings.slice(0, 4).map((one) => <button key={one.name} className="link" onClick={() => { opening.openDrawing(one.name); close(); }}>{one.name}</button>)}
        </p>
      )}
      <p className="quiet">You can drop an SVG, DXF, PDF, photo or scan anywhere on the page; then a laser log or a journal, to watch it on the drawing.</p>
    </section>
  );
}

interface MenuProps {
  opening: Opening;
  download: (kind: "svg" | "excalidraw") => void;
}

export function FileMenu({ opening, download }: MenuProps) {
  const [shown, setShown] = useState(false);
  const { drawings, examples } = useLists(shown);
  const input = useRef<HTMLInputElement>(null);
  const menu = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!shown) return;
    const away = (event: PointerEvent) => {
      if (!menu.current?.contains(event.target as Node)) setShown(false);
    };
    window.addEventListener("pointerdown", away, true);
    return () => window.removeEventListener("pointerdown", away, true);
  }, [shown]);
  const then = (action: () => void) => () => {
    setShown(false);
    action();
  };
  return (
    <div className="menu" ref={menu} onKeyDown={(event) => event.key === "Escape" && setShown(false)}>
      <button aria-expanded={shown} onClick={() => setShown(!shown)}>File</button>
      <input
        ref={input} type="file" hidden data-testid="file-input" aria-label="Open a file"
        onChange={(event) => {
          const file = event.target.files?.[0];
          event.target.value = "";
          if (file) opening.openFile(file);
        }}
      />
      {shown && (
        <div className="card drop">
          <button onClick={then(opening.openEmpty)}>New, empty sheet</button>
          <button onClick={then(() => input.current?.click())}>Open a file of mine (drawing, plan, photo, log, journal) ...</button>
          <button onClick={then(() => download("svg"))}>Download as SVG</button>
          <button onClick={then(() => download("excalidraw"))}>Download as .excalidraw</button>
          {examples.length > 0 && <h3>Examples</h3>}
          {examples.map((one) => <button key={one.name} onClick={then(() => opening.openExample(one.name))}>{one.title ?? one.name}</button>)}
          {drawings.length > 0 && <h3>In this folder</h3>}
          {drawings.map((one) => <button key={one.name} onClick={then(() => opening.openDrawing(one.name))}>{one.name}</button>)}
        </div>
      )}
    </div>
  );
}

/** The name of the drawing; another name makes a copy under that name. */
export function NameField({ name, rename }: { name: string; rename: (name: string) => void }) {
  const [typed, setTyped] = useState<string | null>(null);
  const commit = () => {
    const wanted = typed?.trim() ?? "";
    setTyped(null);
    if (wanted && wanted !== name) rename(/\.svg$/i.test(wanted) ? wanted : `${wanted}.svg`);
  };
  return (
    <input
      className="name" aria-label="Name of the drawing" placeholder="not saved yet" value={typed ?? name}
      onChange={(event) => setTyped(event.target.value)} onBlur={commit}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key === "Enter") event.currentTarget.blur();
        if (event.key === "Escape") setTyped(null);
      }}
    />
  );
}
