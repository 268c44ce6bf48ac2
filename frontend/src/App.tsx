// The page: the sheet with what is understood of it, or a drive on it.
import { CaptureUpdateAction, Excalidraw, restoreElements } from "@excalidraw/excalidraw";
import type { AppState, BinaryFileData, ExcalidrawImperativeAPI } from "@excalidraw/excalidraw/types";
import { useCallback, useEffect, useMemo, useRef, useState } from "react";
import { ApiError, loadDrawing, sendRecording, SVG } from "./api";
import { cellAt, describeCell } from "./cells";
import { Dialog, MeasureDialog } from "./Dialog";
import { closeGap, cutDoor, doorFor, doorWidth, type Gap } from "./doors";
import { DriveControls } from "./DriveControls";
import { DriveSetup, FIRST_CHOICE, orderOf } from "./DriveSetup";
import { DriveView } from "./DriveView";
import { AT_FIRST, OFFERED } from "./editor";
import type { Fate } from "./fate";
import { RobotControls } from "./RobotControls";
import { FileMenu, NameField, Welcome } from "./Files";
import { saveFile, stem } from "./disk";
import { Findings, Overlay, toScene, type View } from "./Overlay";
import { COLOR, goalOf, newGoal, newMeasure, newStart, newStroke, PEN, recolored, roleOf, scaleOf, startOf, STYLES, STYLE_HINT, type Element, type Style } from "./scene";
import { drawingToSvg, sceneText } from "./svg";
import { Toolbar } from "./Toolbar";
import { ToolLayer, TOOLS, TWO_POINTS, type Tool } from "./Tools";
import type { Mend, Point } from "./types";
import { useAutosave } from "./useAutosave";
import { useDrive, type Order } from "./useDrive";
import { useEditorKeys } from "./useEditorKeys";
import { useOpening } from "./useOpening";
import { remark, useUnderstanding } from "./useUnderstanding";

const GOAL_SIZE = 24;
const START_LENGTH = 50; // of a start arrow that was only clicked [scene units]
const NOTICE_MS = 6000;

export function App() {
  const [editor, setEditor] = useState<ExcalidrawImperativeAPI | null>(null);
  const [revision, setRevision] = useState(0);
  const [view, setView] = useState<View>({ scrollX: 0, scrollY: 0, zoom: 1 });
  const [tool, setTool] = useState<Tool>("none");
  const [style, setStyle] = useState<Style>("wall");
  const [pointed, setPointed] = useState<Point | null>(null);
  const [preview, setPreview] = useState<Point[]>([]);
  const [ends, setEnds] = useState<Point[]>([]);
  const [measuring, setMeasuring] = useState<Gap | null>(null);
  const [driving, setDriving] = useState(false);
  const [choice, setChoice] = useState(FIRST_CHOICE);
  const [goalName, setGoalName] = useState("");
  const [fate, setFate] = useState<Fate>("none");
  const [welcome, setWelcome] = useState(!location.hash.includes("drawing="));
  const [notice, setNotice] = useState({ text: "", stays: false });
  const version = useRef(0);
  const layDown = useRef(() => {});
  const otherwise = useRef<Order | null>(null); // tried if a recording does not go with the file that is open
  const { drive, begin, resume, restart, send, leave } = useDrive();
  const refused = drive !== null && drive.fatal && !drive.session;
  const watching = drive !== null && driving && !refused; // else the drive goes on behind the sheet

  const elements = useCallback(() => (editor?.getSceneElements() ?? []) as readonly Element[], [editor]);
  const files = useCallback(() => editor?.getFiles() ?? {}, [editor]);
  const plain = useCallback(() => drawingToSvg(elements(), null), [elements]);
  const whole = useCallback(() => (elements().length ? drawingToSvg(elements(), files()) : ""), [elements, files]);
  const save = useAutosave(whole, revision);
  const routeEnds = useMemo<[Point, Point] | null>(() => (ends.length === 2 ? [ends[0]!, ends[1]!] : null), [ends]);
  useEditorKeys(!watching);
  const { told, error } = useUnderstanding(plain, save.document.name, revision, routeEnds);

  const tell = useCallback((text: string, stays = false) => setNotice({ text, stays }), []); // until something else is told, or for a while
  useEffect(() => {
    if (!notice.text || notice.stays) return;
    const timer = setTimeout(() => tell(""), NOTICE_MS);
    return () => clearTimeout(timer);
  }, [notice, tell]);

  // The address remembers drawing and drive, so that a reload goes on with both.
  const session = drive?.session?.session;
  useEffect(() => {
    const hash = new URLSearchParams();
    if (save.document.name) hash.set("drawing", save.document.name);
    if (session && driving) hash.set("session", session);
    if (editor && (save.document.name || session)) history.replaceState(null, "", `#${hash}`);
  }, [editor, save.document.name, session, driving]);

  const editorTool = useRef("selection");
  const changed = useCallback((all: readonly Element[], state: Pick<AppState, "scrollX" | "scrollY" | "zoom" | "activeTool">) => {
    const { scrollX, scrollY, zoom, activeTool } = state;
    const isTaken = activeTool.type !== editorTool.current && activeTool.type !== "selection";
    editorTool.current = activeTool.type;
    if (isTaken) layDown.current();
    setView((before) => (before.scrollX === scrollX && before.scrollY === scrollY && before.zoom === zoom.value ? before : { scrollX, scrollY, zoom: zoom.value }));
    const sum = all.reduce((total, one) => (total * 31 + one.versionNonce + (one.isDeleted ? 1 : 0)) % 9007199254, all.length);
    if (sum === version.current) return;
    version.current = sum;
    remark("stroke");
    setRevision((before) => before + 1);
    if (all.some((one) => !one.isDeleted)) setWelcome(false);
  }, []);

  const put = useCallback((next: Element[]) => {
    editor?.updateScene({ elements: next, captureUpdate: CaptureUpdateAction.IMMEDIATELY });
  }, [editor]);

  const show = useCallback((shown: { elements: Element[]; files: Record<string, BinaryFileData> }) => {
    if (!editor) return;
    editor.addFiles(Object.values(shown.files));
    editor.updateScene({ elements: restoreElements(shown.elements, null), captureUpdate: CaptureUpdateAction.NEVER });
    editor.history.clear();
    if (shown.elements.length) editor.scrollToContent(undefined, { fitToContent: true });
    setEnds([]);
    setPointed(null);
    setGoalName("");
  }, [editor]);

  const watch = useCallback((file: File) => {
    tell(`reading ${file.name} ...`, true);
    sendRecording(file).then(
      (recording) => {
        tell("");
        setChoice((before) => ({ ...before, recording, world: "" }));
        leave();
        setDriving(true);
        setWelcome(false);
      },
      (problem: unknown) => tell(problem instanceof Error ? problem.message : String(problem)),
    );
  }, [leave, tell]);
  const beginDrawing = () => {
    choose("none");
    setPen("wall");
    editor?.setActiveTool({ type: "freedraw" });
  };
  const { opening, openNamed, guarded, origin } = useOpening({ save, whole, show, tell, watch, leave, begin: beginDrawing });

  // Once, when the editor is ready: go on with what the address names.
  const began = useRef(false);
  useEffect(() => {
    if (!editor || began.current) return;
    began.current = true;
    performance.mark("ready");
    document.body.dataset.ready = "yes";
    const hash = new URLSearchParams(location.hash.slice(1));
    const [name, id] = [hash.get("drawing"), hash.get("session")];
    if (name) guarded(() => openNamed(name));
    if (id) {
      setDriving(true);
      setWelcome(false);
      resume(id);
    }
  }, [editor, guarded, openNamed, resume]);

  const gaps = useMemo(() => (told?.gateways ?? []).map((one) => one.segment as Gap), [told]);
  const scale = scaleOf(elements());

  const doorOf = (from: Point, to: Point, isClick: boolean) => doorFor(elements(), doorWidth(elements(), gaps, scale), view.zoom, from, to, isClick);

  const useTool = (from: Point, to: Point, isClick: boolean) => {
    setPreview([]);
    if (tool === "door") {
      const found = doorOf(from, to, isClick);
      if (!found) return tell("there is no wall here to cut a door into");
      const { door, moved } = found;
      put(cutDoor(moved.reduce(closeGap, [...elements()]), door));
    } else if (tool === "line" && !isClick) {
      put([...elements(), newStroke([from, to], { strokeColor: COLOR[PEN[style] ? "wall" : style] })]);
    } else if (tool === "goal") {
      put([...elements().filter((one) => roleOf(one) !== "goal"), newGoal(to, GOAL_SIZE)]);
      setGoalName("");
      choose("none");
    } else if (tool === "start") {
      const tip: Point = isClick ? [from[0] + START_LENGTH, from[1]] : to;
      put([...elements().filter((one) => roleOf(one) !== "start"), newStart(from, tip)]);
      choose("none");
    } else if (tool === "measure" && !isClick) {
      setMeasuring([from, to]);
    } else if (tool === "route") {
      setEnds((before) => (before.length === 1 ? [...before, to] : [to]));
    }
  };

  const hovered = useMemo(() => (pointed ? cellAt(told, pointed) : undefined), [told, pointed]);
  const point = (event: React.PointerEvent) => { // a finger points where it taps
    const box = event.currentTarget.getBoundingClientRect();
    if (tool === "none") setPointed(toScene(view, [event.clientX - box.left, event.clientY - box.top]));
  };
  const choose = (next: Tool) => {
    setTool(next);
    setPreview([]);
    if (next !== "route") setEnds([]);
    if (next !== "none") editor?.setActiveTool({ type: "selection" });
  };
  // Who takes a tool of the editor lays down the table's own, and wants to draw.
  layDown.current = () => {
    choose("none");
    setWelcome(false);
  };

  // A zone is only drawn: what is selected may just be the last wall. Other styles change what is selected, too,
  // unless a pen is in hand: then they are for the next mark.
  const setPen = (next: Style) => {
    setStyle(next);
    choose("none");
    const pen = PEN[next];
    const { selectedElementIds, activeTool } = editor?.getAppState() ?? {};
    const selected = pen || activeTool?.type !== "selection" ? {} : (selectedElementIds ?? {});
    const all = elements().map((one) => (selected[one.id] && STYLES.some((style) => style === roleOf(one)) ? recolored(one, next) : one));
    const count = all.filter((one, k) => one !== elements()[k]).length;
    if (count) tell(`${count === 1 ? "the selected mark is" : `${count} selected marks are`} now ${next}, and so is what you draw next`);
    editor?.updateScene({ elements: all, appState: { currentItemStrokeColor: COLOR[next] }, captureUpdate: CaptureUpdateAction.IMMEDIATELY });
    if (pen) editor?.setActiveTool({ type: pen, locked: true });
    else if (activeTool?.type === "selection" && Object.keys(selected).length === 0) editor?.setActiveTool({ type: "freedraw" });
  };

  const mend = (one: Mend) => put(one.kind === "cut" ? cutDoor(elements(), one.segment) : closeGap(elements(), one.segment));

  const go = () => {
    const start = startOf(elements());
    const goal = goalName || goalOf(elements());
    const { name } = save.document;
    const drawn = { content: { media: SVG, text: plain() }, ...(name ? { drawing: name } : {}) };
    setFate("none");
    setTool("none");
    if (!save.document.name && elements().length) save.adopt(save.document, null); // so that a reload finds it
    const order = {
      type: "start", ...drawn, ...(goal && !choice.recording ? { goal } : {}),
      ...(start && choice.tellStart && !choice.recording ? { start } : {}), ...orderOf(choice),
    };
    const source = choice.recording && origin();
    otherwise.current = source ? order : null;
    begin(source ? { ...order, content: undefined, drawing: undefined, ...source } : order);
  };

  // A simulated drive goes on meanwhile; a real robot is not commanded by a page that does not show it.
  const isRobot = drive?.session?.kind === "robot";
  const lookAtSheet = () => {
    if (isRobot || drive?.fatal) leave();
    setDriving(false);
  };

  const again = () => {
    if (!drive?.session) return go();
    setFate("none");
    restart(drive.session.session, drive.speed);
  };

  // A journal is in the units of the file that is open, or of the sheet if it was driven at the table.
  useEffect(() => {
    if (!refused || !otherwise.current) return;
    begin(otherwise.current);
    otherwise.current = null;
  }, [refused, begin]);

  const download = (kind: "svg" | "excalidraw") => {
    const text = kind === "svg" ? drawingToSvg(elements(), files()) : sceneText(elements(), files());
    saveFile(`${stem(save.document.name || save.document.base)}.${kind}`, new Blob([text], { type: kind === "svg" ? SVG : "application/json" }));
  };

  const rename = (name: string) => {
    loadDrawing(name).then(
      () => tell(`there is a drawing ${name} already: choose another name`),
      (problem: ApiError) => {
        if (problem.status === 404) save.adopt({ name, base: stem(name), tag: null }, null);
        else tell(`a drawing cannot be called ${name}: ${problem.message}`);
      },
    );
  };
  const keepCopy = () => save.adopt({ ...save.document, name: "", tag: null }, null);
  const showOther = () => {
    const { name } = save.document;
    keepCopy();
    guarded(() => openNamed(name));
  };

  const names = [...new Set((told?.cells ?? []).map((cell) => cell.name).filter(Boolean))].sort();
  const bottomLine = hovered ? describeCell(hovered, told, scale) : (TOOLS.find((one) => one.tool === tool)?.hint ?? STYLE_HINT[style] ?? "");

  return (
    <div
      className={`app ${watching ? "live" : driving ? "setup-open" : ""}`}
      onDragOver={(event) => event.dataTransfer.types.includes("Files") && event.preventDefault()}
      onDropCapture={(event) => {
        const file = event.dataTransfer.files[0];
        if (!file) return;
        event.preventDefault();
        event.stopPropagation();
        opening.openFile(file);
      }}
    >
      <header>
        <h1>pilotage</h1>
        <FileMenu opening={opening} download={download} />
        <NameField name={save.document.name} rename={rename} />
        <span className={`save-state ${save.state}`} data-testid="save-state" title={save.error}>
          {save.document.name || save.state !== "saved" ? { saved: "saved", saving: "saving ...", conflict: "changed elsewhere", failed: "not saved" }[save.state] : ""}
        </span>
        <nav aria-label="Mode">
          <button aria-pressed={!driving} onClick={lookAtSheet}>Draw</button>
          <button aria-pressed={driving} onClick={() => { setDriving(true); setWelcome(false); }}>{drive && !driving && !refused ? "Back to the drive" : "Drive"}</button>
        </nav>
      </header>

      <main>
        <div
          className="sheet-area" hidden={watching}
          onPointerMove={point}
          onPointerDown={point}
          onPointerLeave={(event) => event.pointerType !== "touch" && setPointed(null)}
          onClick={(event) => (event.target as HTMLElement).closest('[data-testid="toolbar-selection"]') && choose("none")}
        >
          <Excalidraw
            excalidrawAPI={setEditor}
            onChange={changed}
            handleKeyboardGlobally={false}
            autoFocus
            aiEnabled={false}
            initialData={AT_FIRST}
            UIOptions={OFFERED}
          />
          <Overlay told={told} view={view} hovered={hovered?.id ?? ""} goal={goalOf(elements())} ends={ends} preview={preview} mend={mend} />
          {tool !== "none" && (
            <ToolLayer
              tool={tool} view={view} hover={setPointed} leave={() => choose("none")} use={useTool}
              preview={(from, to) => setPreview(tool === "door" ? (doorOf(from, to, false)?.door ?? []) : TWO_POINTS.includes(tool) ? [from, to] : [])}
            />
          )}
          <Toolbar tool={tool} choose={choose} style={style} setPen={setPen} />
          {welcome && <Welcome opening={opening} close={() => setWelcome(false)} />}
          <div className="bottom-line">
            <Findings told={told} error={error} mend={mend} />
            <span data-testid="hover">{bottomLine}</span>
          </div>
        </div>
        {watching && <DriveView drive={drive} fate={fate} setFate={setFate} send={send} />}
      </main>

      {watching && isRobot && <RobotControls drive={drive} fate={fate} setFate={setFate} send={send} leave={leave} />}
      {watching && !isRobot && <DriveControls drive={drive} fate={fate} setFate={setFate} send={send} restart={again} leave={leave} />}
      {driving && !watching && (
        <DriveSetup
          refusal={refused ? drive.error : ""}
          choice={choice} setChoice={setChoice} goals={names} goal={goalName} setGoal={setGoalName}
          hasGoal={goalOf(elements()) !== null} hasStart={startOf(elements()) !== null} watch={watch} go={go}
        />
      )}
      {measuring && (
        <MeasureDialog
          close={() => setMeasuring(null)}
          measured={(metres) => {
            put([...elements(), newMeasure(measuring[0], measuring[1], metres)]);
            setMeasuring(null);
            choose("none");
          }}
        />
      )}
      {save.state === "conflict" && (
        <Dialog title="This drawing was changed elsewhere">
          <p>{save.document.name} was saved by another tab or program since you opened it. Neither version is lost.</p>
          <button className="primary" onClick={keepCopy}>Keep mine as a copy</button>
          <button onClick={showOther}>Keep mine as a copy, and show the other version</button>
        </Dialog>
      )}
      {notice.text && <div className="notice" role="alert">{notice.text} <button aria-label="Close this notice" onClick={() => tell("")}>x</button></div>}
    </div>
  );
}
