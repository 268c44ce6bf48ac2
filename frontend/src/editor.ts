// How the editor of the sheet is set up.
import type { ExcalidrawProps } from "@excalidraw/excalidraw/types";
import { COLOR } from "./scene";

// The editor's properties never change, so that it is not painted anew with each frame of a drive.
export const AT_FIRST: ExcalidrawProps["initialData"] = {
  appState: { currentItemRoughness: 0, currentItemStrokeWidth: 2, currentItemRoundness: "sharp", currentItemStrokeColor: COLOR.wall, currentItemFontFamily: 5, viewBackgroundColor: "#ffffff" },
};
export const OFFERED: ExcalidrawProps["UIOptions"] = {
  canvasActions: { export: false, saveToActiveFile: false, loadScene: false, saveAsImage: false, toggleTheme: false, changeViewBackgroundColor: false, clearCanvas: false }, tools: { image: false },
};
