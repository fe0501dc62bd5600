'use strict';
/* Conveyors on the floor plan with what belongs to them: sensors, stoppers, diverters, pushers; and lamps. */

const Conveyors = (() => {
  const { view, toScreen, trace } = Pen;

  const laneFrame = (machine, lane, ms) =>
    (lane.on === null ? null : Motion.cylinderFrame(machine.number, lane.on, ms));

  /* A point of the surface of a conveyor, so far from its beginning. */
  function onLane(lane, frame, gone, across) {
    const lies = Motion.pointOn(lane.line, Motion.endsOf(lane.line)[1] - gone, across);
    return frame ? Motion.point(frame, lies) : lies;
  }

  /* Distance of the marks on a surface, m. */
  const CHEVRON = 0.2;

  function drawLane(machine, lane, ms) {
    const context = Pen.context();
    const colours = Colours.get();
    const frame = laneFrame(machine, lane, ms);
    trace(Scene.laneBand(lane, frame, lane.outline));
    context.fillStyle = colours.lane;
    context.fill();
    context.strokeStyle = colours['lane-edge'];
    context.lineWidth = 1;
    context.stroke();
    // Marks that go with the surface.
    if (CHEVRON * view.scale < 7) return;
    const [end, begin] = Motion.endsOf(lane.line);
    const half = Math.min(lane.width / 4, 0.06);
    context.beginPath();
    for (let gone = Motion.travelAt(machine.number, lane.part, ms) % CHEVRON; gone < begin - end; gone += CHEVRON) {
      const points = [[Math.max(gone - half, 0), half], [gone, 0], [Math.max(gone - half, 0), -half]];
      points.forEach(([at, across], i) => context[i ? 'lineTo' : 'moveTo'](...toScreen(onLane(lane, frame, at, across))));
    }
    context.stroke();
  }

  /* A sensor across a conveyor, drawn through while it sees something. */
  function drawBeam(machine, beam, ms) {
    const context = Pen.context();
    const lane = Motion.laneOf(machine.number, beam.lane), frame = laneFrame(machine, lane, ms);
    const sees = beam.signal !== null && Data.valueAt(beam.signal, ms);
    context.lineWidth = sees ? 2.5 : 1.25;
    context.setLineDash(sees ? [] : [3, 3]);
    context.strokeStyle = Colours.get().bad;
    trace([-1, 1].map((side) => onLane(lane, frame, beam.at, (side * lane.outline) / 2)), false);
    context.stroke();
    context.setLineDash([]);
  }

  /* A stopper, a diverter or a pusher, as far out as its cylinder is. */
  function drawGate(machine, gate, ms) {
    const context = Pen.context();
    const lane = Motion.laneOf(machine.number, gate.lane), frame = laneFrame(machine, lane, ms);
    const out = Motion.outAt(machine.number, gate.cylinder, ms), half = lane.outline / 2;
    const onto = gate.onto === null ? null : Motion.laneOf(machine.number, gate.onto);
    // To which side it leads: across the lane, to the left of the direction of travel.
    let side = 1;
    if (onto) {
      const [begin] = [onLane(onto, laneFrame(machine, onto, ms), 0, 0)];
      const [left, right] = [1, -1].map((sign) => onLane(lane, frame, gate.at, sign * half));
      side = Math.hypot(begin[0] - left[0], begin[1] - left[1]) < Math.hypot(begin[0] - right[0], begin[1] - right[1]) ? 1 : -1;
    }
    const points = {
      stopper: () => [[gate.at, -half * out], [gate.at, half * out]],
      diverter: () => [[gate.at, -side * half], [gate.at + 2 * half * (1 - 0.4 * out), -side * half + 2 * side * half * out]],
      pusher: () => [-1, 1].map((end) => [gate.at + (end * gate.width) / 2, -side * half + 2 * side * half * out]),
    }[gate.kind]();
    context.strokeStyle = Colours.get().ink;
    context.globalAlpha = out > 0 ? 1 : 0.35;
    context.lineWidth = Math.max(3, 0.012 * view.scale);
    context.lineCap = 'butt';
    trace(points.map(([at, across]) => onLane(lane, frame, at, across)), false);
    context.stroke();
    context.globalAlpha = 1;
  }

  const LAMPS = { red: '#e5484d', yellow: '#e8b70e', amber: '#f08c1a', orange: '#f08c1a', green: '#2fa35b', blue: '#3b82f6', white: '#f4f6fa' };

  /* Lamps of one place stand side by side. */
  function drawLamps({ lamps }, ms) {
    const before = new Map();
    for (const lamp of lamps) {
      const key = lamp.at.join(), count = before.get(key) || 0;
      before.set(key, count + 1);
      drawLamp(lamp, 17 * count, ms);
    }
  }

  function drawLamp({ at, colour, signal }, right, ms) {
    const context = Pen.context();
    const [x, y] = [toScreen(at)[0] + right, toScreen(at)[1]], isOn = signal !== null && Data.valueAt(signal, ms);
    const fill = Object.hasOwn(LAMPS, colour) ? LAMPS[colour] : Colours.get().muted;
    context.beginPath();
    context.arc(x, y, 6, 0, 2 * Math.PI);
    context.fillStyle = fill;
    context.globalAlpha = isOn ? 1 : 0.15;
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = isOn ? 2.5 : 1;
    context.strokeStyle = isOn ? fill : Colours.get().muted;
    context.stroke();
  }

  /* Of one machine. */
  function draw(machine, ms) {
    machine.lanes.forEach((lane) => drawLane(machine, lane, ms));
    machine.beams.forEach((beam) => drawBeam(machine, beam, ms));
    machine.gates.forEach((gate) => drawGate(machine, gate, ms));
  }

  return { draw, drawLamps };
})();
