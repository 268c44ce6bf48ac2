import "@excalidraw/excalidraw/index.css";
import "./style.css";
import { createRoot } from "react-dom/client";
import { App } from "./App";

window.EXCALIDRAW_ASSET_PATH = "/assets/";

createRoot(document.getElementById("root")!).render(<App />);
