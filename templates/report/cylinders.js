'use strict';
/* Cylinders on the floor plan, where the device says what is on them: the stroke, and how far out they are. */

const Cylinders = (() => {
  const { view, toScreen, trace } = Pen;

  /* Where what is on a cylinder is while it is at its inner end: the middle of its first body, else of its conveyor. */
  function carried(machine, { part }) {
    const body = machine.bodies.find(({ on }) => on.cylinder === part);
    if (body) return body.pose.slice(9, 12);
    const lane = machine.lanes.find(({ on }) => on === part);
    if (!lane) return null;
    const [end, begin] = Motion.endsOf(lane.line);
    return Motion.pointOn(lane.line, (end + begin) / 2, 0);
  }

  /* Points of the stroke from the inner end to the outer one; more than two of one that turns. */
  function stroke(cylinder, from) {
    const count = cylinder.stroke.slides ? 1 : 16;
    return Array.from({ length: count + 1 }, (_, i) => Motion.point(Motion.strokeFrame(cylinder, i / count), from));
  }

  /* Strokes that look shorter go up or down: drawn as a dial, full at the outer end. */
  const SHORTEST_PIXELS = 6, DIAL_PIXELS = 7;

  function draw(machine, ms) {
    const context = Pen.context(), { ink } = Colours.get();
    for (const cylinder of machine.cylinders) {
      const from = cylinder.stroke && carried(machine, cylinder);
      if (!from) continue;
      const points = stroke(cylinder, from), out = Motion.outAt(machine.number, cylinder.part, ms);
      const last = points[points.length - 1];
      const [x, y] = toScreen(Motion.point(Motion.strokeFrame(cylinder, out), from));
      context.strokeStyle = context.fillStyle = ink;
      context.lineWidth = 1.5;
      context.beginPath();
      if (Math.hypot(last[0] - from[0], last[1] - from[1]) * view.scale < SHORTEST_PIXELS) {
        context.arc(x, y, DIAL_PIXELS, 0, 2 * Math.PI);
        context.stroke();
        context.beginPath();
        context.moveTo(x, y);
        context.arc(x, y, DIAL_PIXELS, -Math.PI / 2, -Math.PI / 2 + 2 * Math.PI * out);
        context.fill();
        continue;
      }
      trace(points, false);
      context.setLineDash([5, 3]);
      context.stroke();
      context.setLineDash([]);
      context.beginPath();
      context.arc(x, y, 3.5, 0, 2 * Math.PI);
      context.fill();
    }
  }

  return { draw };
})();
