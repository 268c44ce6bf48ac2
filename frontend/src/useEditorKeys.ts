// Keys of the editor that reach the page elsewhere, as after a click on a tool or a mend: undo, redo, and tools by letter or digit.
import { useEffect } from "react";

const UNDO = /^[yz]$/i;
const TOOL = /^[a-z0-9]$/i;
const KEEPS_KEYS = ".excalidraw, input, select, textarea, dialog, .menu";

export function useEditorKeys(isDrawing: boolean): void {
  useEffect(() => {
    if (!isDrawing) return;
    const passOn = (event: KeyboardEvent) => {
      const { key, code, ctrlKey, metaKey, shiftKey, altKey, target } = event;
      const isMeant = ctrlKey || metaKey ? UNDO.test(key) : TOOL.test(key);
      if (!isMeant || altKey || event.defaultPrevented || (target as Element).closest(KEEPS_KEYS)) return;
      event.preventDefault();
      document.querySelector(".excalidraw")?.dispatchEvent(new KeyboardEvent("keydown", { key, code, ctrlKey, metaKey, shiftKey, bubbles: true, cancelable: true }));
    };
    window.addEventListener("keydown", passOn);
    return () => window.removeEventListener("keydown", passOn);
  }, [isDrawing]);
}
