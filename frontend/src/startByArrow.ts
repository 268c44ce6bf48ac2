// Where a real robot stands: told by an arrow that is dragged on the drawing.
import type { Fate } from "./fate";
import type { Order } from "./useDrive";
import type { Point, Pose } from "./types";

export function startByArrow(fate: Fate, send: (order: Order) => void, done: () => void, show: (arrow: Pose | null) => void) {
  return {
    grabs: () => fate === "start",
    onDrag: ([x, y]: Point, [tipX, tipY]: Point, released: boolean) => {
      const heading = Math.atan2(y - tipY, tipX - x); // counter-clockwise on the page, whose y points down
      show(released ? null : [x, y, heading]);
      if (!released) return;
      send({ type: "place", x, y, heading });
      done();
    },
  };
}
