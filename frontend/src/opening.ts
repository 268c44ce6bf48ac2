// Files as scenes of the editor: its own ones as they are, all others as the server reads them.
import { restoreElements } from "@excalidraw/excalidraw";
import type { BinaryFileData, BinaryFiles } from "@excalidraw/excalidraw/types";
import { upload } from "./api";
import { newGoal, newMeasure, newPicture, newStart, newStroke, newText, COLOR, type Element, type Style } from "./scene";
import { sceneIn, type Scene } from "./svg";
import { ZONES, type Point, type Stroke, type Upload } from "./types";

const SIZE = 1000; // longer side of a drawing that comes from elsewhere [scene units]
const LARGEST_PICTURE = 1600; // longer side of a photo that is kept under the drawing [px]
const MEASURE_BELOW = 40; // how far below the drawing a measure tells its scale [scene units]
const CORNER: Point = [120, 90]; // where it is put
const PICTURE = /^image\/(png|jpe?g|webp)$/;

export interface Opened extends Scene {
  svg: string | null; // the drawing as the server read it, in the units of its file; null if it was the table's own
  notes: string[];
}

/** Makes a scene of a file; `drawing` is its name in the folder if it is there. */
export async function openContent(name: string, content: Blob, drawing = ""): Promise<Opened> {
  const isText = /\.(svg|excalidraw|json)$/i.test(name);
  const scene = isText ? sceneIn(await content.text()) : null;
  if (scene) return { elements: restoreElements(scene.elements, null), files: scene.files, svg: null, notes: [] };
  const read = await upload(name, content, drawing);
  const isPicture = PICTURE.test(content.type); // it shows its furniture itself
  const opened = elementsOf(isPicture ? { ...read, furniture: [] } : read);
  if (!isPicture) return opened;
  const picture = await pictureUnder(content, read).catch(() => null);
  return picture
    ? { ...opened, elements: [picture.element, ...opened.elements], files: picture.files, notes: [...opened.notes, "the picture lies under the drawing"] }
    : opened;
}

function placing({ bounds: [left, top, right, bottom] }: Upload) {
  const scale = SIZE / Math.max(right - left, bottom - top, 1e-9);
  return { scale, at: ([x, y]: Point): Point => [CORNER[0] + scale * (x - left), CORNER[1] + scale * (y - top)] };
}

function elementsOf(read: Upload): Opened {
  const { at } = placing(read);
  const strokeOf = ({ points, closed }: Stroke, style: Style) =>
    newStroke((closed ? [...points, points[0]!] : points).map(at), { strokeColor: COLOR[style] });
  const strokes = read.strokes.map((one) => strokeOf(one, "wall"));
  const furniture = read.furniture.map((one) => strokeOf(one, "furniture"));
  const zones = ZONES.flatMap((kind) => read.zones[kind].map((points) =>
    newStroke((kind === "one-way" ? points : [...points, points[0]!]).map(at), { strokeColor: COLOR[kind] }, kind === "one-way" ? "arrow" : "line")));
  const labels = read.labels.map(({ text, x, y }) => newText(text, at([x, y]), 20));
  const goal = read.goal ? [newGoal(at(read.goal), 24)] : [];
  const start = read.start ? [newStart(at(read.start), [at(read.start)[0] + 40, at(read.start)[1]])] : [];
  const [left, , right, bottom] = read.bounds;
  const below = (x: number): Point => [at([x, bottom])[0], at([x, bottom])[1] + MEASURE_BELOW];
  const measure = read.metres_per_unit ? [newMeasure(below(left), below(right), read.metres_per_unit * (right - left))] : [];
  return { elements: [...furniture, ...strokes, ...zones, ...labels, ...start, ...goal, ...measure] as Element[], files: {}, svg: read.svg, notes: read.notes };
}

async function pictureUnder(content: Blob, read: Upload): Promise<{ element: Element; files: BinaryFiles }> {
  const image = await createImageBitmap(content);
  const shrink = Math.min(1, LARGEST_PICTURE / Math.max(image.width, image.height));
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [Math.round(image.width * shrink), Math.round(image.height * shrink)];
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  const id = crypto.getRandomValues(new Uint32Array(4)).join("");
  const { at } = placing(read);
  const [left, top] = at([0, 0]);
  const [right, bottom] = at([image.width, image.height]);
  const file = { id, mimeType: "image/jpeg", dataURL: canvas.toDataURL("image/jpeg", 0.8), created: 0 } as unknown as BinaryFileData;
  return { element: newPicture(id, [left, top, right, bottom]), files: { [id]: file } };
}
