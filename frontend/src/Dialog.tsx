// A question that must be answered before one goes on.
import { useEffect, useRef, useState, type ReactNode } from "react";

export function Dialog({ title, children, close }: { title: string; children: ReactNode; close?: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    dialog.current?.showModal();
  }, []);
  return (
    <dialog
      ref={dialog} aria-label={title} className="card"
      onKeyDown={(event) => event.stopPropagation()}
      onCancel={(event) => {
        event.preventDefault();
        close?.();
      }}
    >
      <h2>{title}</h2>
      {children}
    </dialog>
  );
}

export function MeasureDialog({ measured, close }: { measured: (metres: number) => void; close: () => void }) {
  const [text, setText] = useState("");
  const metres = Number(text.replace(",", "."));
  const valid = Number.isFinite(metres) && metres > 0;
  return (
    <Dialog title="How long is this?" close={close}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          if (valid) measured(metres);
        }}
      >
        <label>
          Length in metres <input autoFocus inputMode="decimal" value={text} onChange={(event) => setText(event.target.value)} />
        </label>
        <button className="primary" type="submit" disabled={!valid}>This is {valid ? metres : "..."} m</button>
        <button type="button" onClick={close}>Cancel</button>
      </form>
    </Dialog>
  );
}
