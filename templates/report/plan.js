'use strict';
/* The floor plan: machines by their bodies, conveyors, items and contacts, from above. x points right, y up. */

const Plan = (() => {
  const { raw, machines } = Data;
  const { canvas, view, size, toScreen, toWorld, trace, paint, label } = Pen;
  const { still, laneBand, floorOf, boxes, extent, isBridge, OVERHEAD } = Scene;
  /* Pixels over the plan for the name of the topmost machine. */
  const NAME = 18;
  const shown = new Map();
  /* Of the items that are shown, the lowest first. */
  const outlines = [];
  let context = null, trail = null;

  function fit() {
    const [w, h] = [0, 1].map((i) => (extent.high[i] - extent.low[i]) * 1.06 + 0.1);
    view.scale = Math.min(size[0] / w, Math.max(size[1] - NAME, 1) / h, 900);
    view.x = (extent.low[0] + extent.high[0]) / 2;
    view.y = (extent.low[1] + extent.high[1]) / 2 + NAME / 2 / view.scale;
    view.isFitted = true;
  }

  /* ---- Drawing ---- */

  function grid() {
    const colours = Colours.get();
    const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100].find((metres) => metres * view.scale >= 34) || 200;
    const [left, top] = toWorld([0, 0]), [right, bottom] = toWorld(size);
    context.lineWidth = 1;
    context.strokeStyle = colours.grid;
    context.beginPath();
    for (let x = Math.ceil(left / step) * step; x <= right; x += step) {
      const px = Math.round(toScreen([x, 0])[0]) + 0.5;
      context.moveTo(px, 0);
      context.lineTo(px, size[1]);
    }
    for (let y = Math.ceil(bottom / step) * step; y <= top; y += step) {
      const py = Math.round(toScreen([0, y])[1]) + 0.5;
      context.moveTo(0, py);
      context.lineTo(size[0], py);
    }
    context.stroke();
    scaleBar(step);
  }

  function scaleBar(step) {
    const colours = Colours.get();
    const length = step * view.scale, [x, y] = [16, size[1] - 16];
    context.strokeStyle = context.fillStyle = colours.muted;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x, y - 4);
    context.lineTo(x, y);
    context.lineTo(x + length, y);
    context.lineTo(x + length, y - 4);
    context.stroke();
    context.font = `11px ${colours.font}`;
    context.textAlign = 'left';
    context.textBaseline = 'alphabetic';
    context.fillText(`${step} m`, x + length + 6, y);
  }

  function drawFloors(ms) {
    const colours = Colours.get();
    context.lineWidth = 1;
    for (const machine of machines) {
      for (const { points, isArea } of machine.rails) {
        trace(points, isArea);
        context.strokeStyle = colours['solid-edge'];
        context.setLineDash(isArea ? [8, 6] : []);
        context.lineWidth = isArea ? 1 : 3;
        context.globalAlpha = 0.45;
        context.stroke();
        context.globalAlpha = 1;
        context.setLineDash([]);
        context.lineWidth = 1;
      }
      if (machine.stops.length > 1) {
        context.setLineDash([2, 5]);
        context.strokeStyle = colours.muted;
        trace(machine.stops, false);
        context.stroke();
        context.setLineDash([]);
      }
      if (machine.track) drawTrack(machine.track, colours);
      Conveyors.draw(machine, ms);
    }
  }

  /* The track that a vehicle follows, with its places. */
  function drawTrack({ sides, places }, colours) {
    context.setLineDash([2, 5]);
    context.strokeStyle = colours.muted;
    for (const side of sides) {
      trace(side, false);
      context.stroke();
    }
    context.setLineDash([]);
    context.fillStyle = colours.muted;
    for (const place of places) {
      context.beginPath();
      context.arc(...toScreen(place), 2.5, 0, 2 * Math.PI);
      context.fill();
    }
  }

  /* The sides of a place where it is at a time. */
  function floorAt(machine, place, ms) {
    if (place.carried) return floorOf(place, Motion.positionAt(machine.number, ms));
    const floor = floorOf(place, place.at);
    if (place.on === null) return floor;
    const frame = Motion.cylinderFrame(machine.number, place.on, ms);
    return floor.map(([x, y]) => Motion.point(frame, [x, y, 0]));
  }

  function drawPlaces(ms) {
    const colours = Colours.get();
    for (const machine of machines) for (const place of machine.places) {
      trace(floorAt(machine, place, ms));
      context.fillStyle = colours.panel;
      context.globalAlpha = 0.55;
      context.fill();
      context.globalAlpha = 1;
      context.strokeStyle = colours['solid-edge'];
      context.lineWidth = 1;
      context.stroke();
    }
  }

  function drawStill(isOverhead) {
    const colours = Colours.get();
    context.globalAlpha = isOverhead ? 0.25 : 1;
    still.filter((body) => body.low > OVERHEAD === isOverhead)
      .forEach((body) => paint(body, colours.solid, colours['solid-edge']));
    context.globalAlpha = 1;
  }

  function drawMoving(ms) {
    const colours = Colours.get();
    const placed = Scene.movingAt(ms);
    placed.sort((a, b) => a.high - b.high);
    const counted = machines.map(({ number }) => Data.stayAt(number, ms).counted);
    drawSkeletons(ms, counted);
    for (const body of placed) {
      const isChosen = body.machine === Player.chosen.machine;
      context.globalAlpha = isBridge(body) ? 0.3 : 0.92;
      paint(body, colours[counted[body.machine]], isChosen ? colours.ink : colours.panel);
    }
    context.globalAlpha = 1;
    return placed;
  }

  /* The links of arms whose bodies do not show them all. */
  function drawSkeletons(ms, counted) {
    const colours = Colours.get();
    for (const { number, links, bodies } of machines) {
      if (!links || bodies.filter(({ on }) => on.joint !== undefined).length >= 4) continue;
      const frames = Motion.framesAt(number, ms).slice(-6), base = links.length > 6 ? Motion.framesAt(number, ms)[links.length - 7] : links[0].before;
      const points = [base, ...frames].map((frame) => [frame[9], frame[10]]);
      context.lineCap = context.lineJoin = 'round';
      [[0.11, colours.panel], [0.08, colours[counted[number]]]].forEach(([width, colour]) => {
        trace(points, false);
        context.lineWidth = Math.max(width * view.scale, 2);
        context.strokeStyle = colour;
        context.stroke();
      });
    }
  }

  function drawItems(ms) {
    const colours = Colours.get();
    shown.clear();
    outlines.length = 0;
    const all = [];
    for (const { number, at, endMs } of Motion.items) {
      if (!at.length || ms < at[0]) continue;
      // One that has left the line is nowhere from its last segment on.
      if (ms > endMs && endMs < Data.endMs) continue;
      const found = Motion.itemAt(number, ms);
      if (found) all.push({ number, ...found });
    }
    all.sort((a, b) => a.place[2] - b.place[2]);
    for (const { number, place, turn } of all) {
      const item = Motion.items[number], kind = Motion.kindAt(item, ms);
      shown.set(item.name, place);
      const pose = Motion.turned(turn, place);
      const [w, h] = [kind.size[0] / 2, kind.size[1] / 2];
      const corners = [[-w, -h, 0], [w, -h, 0], [w, h, 0], [-w, h, 0]].map((corner) => Motion.point(pose, corner));
      outlines.push({ number, place, corners });
      paint({ corners }, colours.kinds[raw.kinds.indexOf(kind) % 8], colours.panel);
      if (number === Player.chosen.item) {
        context.lineWidth = 2.5;
        context.strokeStyle = colours.ink;
        context.stroke();
      }
    }
    nameItems(all, ms);
  }

  /* Items that are drawn large enough, and the chosen one. */
  function nameItems(all, ms) {
    for (const { number, place, turn } of all) {
      const item = Motion.items[number], { size: [length, width] } = Motion.kindAt(item, ms);
      // Half of it up and down the canvas, as it is turned.
      const half = (Math.abs(length * Math.sin(turn)) + Math.abs(width * Math.cos(turn))) / 2;
      if (length * view.scale < 30 && number !== Player.chosen.item) continue;
      const [x, y] = toScreen(place);
      label(item.name, [x, y + half * view.scale + 9], 10);
    }
  }

  /* Where the chosen item has been and will be. */
  function drawTrail() {
    const { item } = Player.chosen;
    if (item === null) return;
    if (!trail || trail.item !== item) trail = { item, points: trailOf(Motion.items[item]) };
    context.lineWidth = 2;
    context.strokeStyle = Colours.get().path;
    context.globalAlpha = 0.8;
    trace(trail.points, false);
    context.stroke();
    context.globalAlpha = 1;
  }

  function trailOf({ segments, endMs }) {
    const points = [];
    segments.forEach((segment, i) => {
      const end = i + 1 < segments.length ? segments[i + 1][0] : endMs;
      const steps = segment[2] === 0 ? 0 : segment[2] === 1 ? 1 : 48;
      for (let k = 0; k <= steps; k++) {
        points.push(Motion.placeBy(segment, segment[0] + (steps ? ((end - segment[0]) * k) / steps : 0)));
      }
    });
    return points;
  }

  function drawContacts(ms) {
    const colours = Colours.get();
    for (const contact of Data.results.collisions || []) {
      if (ms < contact.time_s * 1000) continue;
      const [x, y] = toScreen(contact.place);
      context.strokeStyle = colours.bad;
      context.lineWidth = 2;
      context.beginPath();
      context.arc(x, y, ms - contact.time_s * 1000 < 1500 ? 13 : 6, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  /* ---- Names ---- */

  /* Beside what of a machine moves as a whole. */
  function namePlace(machine, ms) {
    const { number, links, stops, track } = machine;
    if (links) {
      // Before the six joints of the arm itself are those that carry it.
      const carrier = links.length > 6 ? Motion.framesAt(number, ms)[links.length - 7] : links[0].before;
      return [carrier[9], carrier[10] + Math.min(34 / view.scale, 0.5)];
    }
    const { low, high } = boxes[number];
    if (track) {
      const [x, y] = Motion.positionAt(number, ms);
      return [x, y + (high[1] - low[1]) / 2 + 12 / view.scale];
    }
    const [dx, dy] = stops.length ? [0, 1].map((i) => Motion.positionAt(number, ms)[i] - stops[0][i]) : [0, 0];
    return [(low[0] + high[0]) / 2 + dx, high[1] + dy + 12 / view.scale];
  }

  /* A name takes about so many squares of its height; together they cover so much of the plan at most. */
  const CHARACTERS = 7, MOST_COVERED = 0.25;

  /* Names that lie on one another are left out, but that of the chosen machine. Where there is no room for names, there
     are only their dots. */
  function drawNames(ms) {
    const colours = Colours.get();
    // Small machines have small names.
    const pixels = Math.min(Math.max(view.scale * 0.25, 8), 12);
    context.font = `600 ${pixels}px ${colours.font}`;
    const isCrowded = machines.length * CHARACTERS * pixels * pixels > MOST_COVERED * (extent.high[0] - extent.low[0])
      * (extent.high[1] - extent.low[1]) * view.scale * view.scale;
    const taken = [];
    const first = machines.filter(({ number }) => number === Player.chosen.machine);
    for (const machine of [...first, ...machines.filter((other) => !first.includes(other))]) {
      const [x, y] = toScreen(namePlace(machine, ms));
      if (isCrowded && !first.includes(machine)) {
        context.beginPath();
        context.arc(x, y, pixels / 3, 0, 2 * Math.PI);
        context.fillStyle = colours[Data.stayAt(machine.number, ms).counted];
        context.fill();
        continue;
      }
      const half = context.measureText(machine.name).width / 2 + pixels;
      const box = [x - half, y - pixels * 0.6, x + half, y + pixels * 0.6];
      const meets = (other) => box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3];
      if (taken.some(meets)) continue;
      taken.push(box);
      label(machine.name, [x, y], pixels, colours[Data.stayAt(machine.number, ms).counted]);
    }
  }

  let drawn = [];
  function draw(ms) {
    if (!Pen.begin()) return;
    context = Pen.context();
    grid();
    drawStill(false);
    drawFloors(ms);
    drawPlaces(ms);
    drawStill(true);
    drawTrail();
    drawn = drawMoving(ms);
    machines.forEach((machine) => Cylinders.draw(machine, ms));
    drawItems(ms);
    machines.forEach((machine) => Conveyors.drawLamps(machine, ms));
    drawContacts(ms);
    drawNames(ms);
    if (ms > Motion.drawnUntil) {
      label(`not drawn after ${clock(Motion.drawnUntil, 0)}: see the end of the page`, [size[0] / 2, size[1] - 18], 13);
    }
  }

  /* ---- The pointer ---- */

  function isInside(corners, [x, y]) {
    let inside = false;
    corners.forEach(([x1, y1], i) => {
      const [x2, y2] = corners[(i + corners.length - 1) % corners.length];
      if (y1 > y !== y2 > y && x < ((x2 - x1) * (y - y1)) / (y2 - y1) + x1) inside = !inside;
    });
    return inside;
  }

  function isOn({ corners, ends, radius }, p) {
    if (corners) return isInside(corners, p);
    const [a, b] = ends, [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const share = Math.min(Math.max(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy || 1), 0), 1);
    return Math.hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy) <= Math.max(radius, 4 / view.scale);
  }

  /* What is at a place of the canvas: the item on top, else the machine on top. */
  function hit(pixel, ms) {
    const p = toWorld(pixel);
    const highestFirst = [...outlines].reverse();
    // Small ones are hit near their middles too.
    const item = highestFirst.find(({ corners }) => isInside(corners, p))
      || highestFirst.find(({ place }) => Math.hypot(place[0] - p[0], place[1] - p[1]) < 5 / view.scale);
    if (item) return { item: item.number };
    const body = [...drawn].reverse().find((body) => !isBridge(body) && isOn(body, p))
      || [...still].reverse().find((body) => body.machine !== null && body.low <= OVERHEAD && isOn(body, p));
    if (body) return { machine: body.machine };
    const on = machines.find((machine) =>
      machine.places.some((place) => isInside(floorAt(machine, place, ms), p))
      || machine.lanes.some((lane) => isInside(laneBand(lane, null, lane.outline), p)));
    return on ? { machine: on.number } : {};
  }

  const pixelOf = (event) => [event.offsetX, event.offsetY];

  function zoom(factor, pixel = [size[0] / 2, size[1] / 2]) {
    const before = toWorld(pixel);
    view.scale = Math.min(Math.max(view.scale * factor, 2), 2000);
    const after = toWorld(pixel);
    view.x += before[0] - after[0];
    view.y += before[1] - after[1];
    view.isFitted = false;
    Player.redraw();
  }

  function listen() {
    let grabbed = null;
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      zoom(Math.exp(-event.deltaY / 500), pixelOf(event));
    }, { passive: false });
    canvas.addEventListener('pointerdown', (event) => {
      grabbed = { pixel: pixelOf(event), x: view.x, y: view.y, isMoved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!grabbed) return;
      const [dx, dy] = pixelOf(event).map((p, i) => p - grabbed.pixel[i]);
      if (Math.hypot(dx, dy) > 4) grabbed.isMoved = true;
      if (!grabbed.isMoved) return;
      view.x = grabbed.x - dx / view.scale;
      view.y = grabbed.y + dy / view.scale;
      view.isFitted = false;
      Player.redraw();
    });
    canvas.addEventListener('pointerup', (event) => {
      if (grabbed && !grabbed.isMoved) Player.choose(hit(pixelOf(event), Player.time()));
      grabbed = null;
    });
    byId('plan-in').addEventListener('click', () => zoom(1.4));
    byId('plan-out').addEventListener('click', () => zoom(1 / 1.4));
    byId('plan-fit').addEventListener('click', () => {
      fit();
      Player.redraw();
    });
  }

  function resize() {
    const box = canvas.parentElement.getBoundingClientRect();
    [size[0], size[1]] = [Math.floor(box.width), Math.floor(box.height)];
    if (view.isFitted) fit();
  }

  return { draw, resize, listen, shown };
})();
