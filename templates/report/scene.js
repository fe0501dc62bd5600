'use strict';
/* What stands on the floor, in the world: outlines of bodies from above, bands of conveyors, floors, and the extent. */

const Scene = (() => {
  const { raw, machines } = Data;

  /* The corners of points from above, in order (Andrew's monotone chain). */
  function hull(points) {
    const sorted = points.map(([x, y]) => [x, y]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const side = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    const half = (all) => {
      const kept = [];
      for (const p of all) {
        while (kept.length > 1 && side(kept[kept.length - 2], kept[kept.length - 1], p) <= 0) kept.pop();
        kept.push(p);
      }
      kept.pop();
      return kept;
    };
    return [...half(sorted), ...half(sorted.reverse())];
  }

  /* A body in the world: its outline from above, with lowest and highest point. */
  function outline(body, frame) {
    const pose = Motion.then(frame, body.pose);
    const { box, capsule } = body.shape;
    if (box) {
      const corners = [];
      for (const x of [-1, 1]) for (const y of [-1, 1]) for (const z of [-1, 1]) {
        corners.push(Motion.point(pose, [(x * box[0]) / 2, (y * box[1]) / 2, (z * box[2]) / 2]));
      }
      const heights = corners.map((corner) => corner[2]);
      return { corners: hull(corners), low: Math.min(...heights), high: Math.max(...heights) };
    }
    const [length, radius] = capsule;
    const ends = [-1, 1].map((side) => Motion.point(pose, [0, 0, (side * length) / 2]));
    const heights = ends.map((end) => end[2]);
    return { ends, radius, low: Math.min(...heights) - radius, high: Math.max(...heights) + radius };
  }

  function frameOf(machine, on, ms) {
    if (on === 'world') return Motion.IDENTITY;
    if (on === 'route') return Motion.turned(Motion.headingAt(machine, ms), Motion.positionAt(machine, ms));
    if (on.cylinder !== undefined) return Motion.cylinderFrame(machine, on.cylinder, ms);
    return Motion.framesAt(machine, ms)[on.joint];
  }

  /* Bodies over everything that items can be on are drawn so that one sees through them, m. */
  const OVERHEAD = 1.3;

  const still = [], moving = [];
  for (const obstacle of raw.obstacles) still.push({ machine: null, ...outline(obstacle.body, Motion.IDENTITY) });
  for (const { number, bodies } of machines) for (const body of bodies) {
    if (body.on === 'world') still.push({ machine: number, ...outline(body, Motion.IDENTITY) });
    else moving.push({ machine: number, body });
  }
  still.sort((a, b) => a.high - b.high);

  function laneBand(lane, frame, across) {
    const [end, begin] = Motion.endsOf(lane.line);
    const count = lane.line.radius ? 24 : 1;
    const side = (i, sign) => {
      const lies = Motion.pointOn(lane.line, end + ((begin - end) * i) / count, (sign * across) / 2);
      return frame ? Motion.point(frame, lies) : lies;
    };
    const steps = Array.from({ length: count + 1 }, (_, i) => i);
    return [...steps.map((i) => side(i, 1)), ...steps.reverse().map((i) => side(i, -1))];
  }

  const floorOf = (place, [x, y]) => place.corners.map((corner) => [x + corner[0], y + corner[1]]);

  function bounds(points) {
    const box = { low: [Infinity, Infinity], high: [-Infinity, -Infinity] };
    points.forEach((p) => [0, 1].forEach((i) => {
      box.low[i] = Math.min(box.low[i], p[i]);
      box.high[i] = Math.max(box.high[i], p[i]);
    }));
    return box;
  }

  /* What a machine takes of the floor at the start, but for its rails and the bodies of an arm. */
  const boxes = machines.map((machine) => {
    const own = still.filter((body) => body.machine === machine.number && body.low <= OVERHEAD);
    const carried = moving.filter(({ machine: other, body }) => other === machine.number && body.on.joint === undefined);
    const points = [
      ...own.flatMap(({ corners, ends }) => corners || ends),
      ...carried.map(({ body }) => outline(body, frameOf(machine.number, body.on, 0))).flatMap(({ corners, ends }) => corners || ends),
      ...machine.lanes.flatMap((lane) => laneBand(lane, null, lane.outline)),
      ...machine.places.flatMap((place) => floorOf(place, place.at)),
    ];
    return bounds(points.length ? points : [machine.pose]);
  });

  const extent = (() => {
    const all = machines.flatMap((machine) => [
      ...machine.stops,
      ...(machine.track ? machine.track.sides.flat() : []),
      ...machine.rails.flatMap(({ points }) => points),
      ...boxes[machine.number].low[0] === Infinity ? [] : [boxes[machine.number].low, boxes[machine.number].high],
    ]);
    still.forEach(({ corners, ends }) => all.push(...(corners || ends)));
    moving.forEach(({ machine, body }) => {
      const { corners, ends } = outline(body, frameOf(machine, body.on, 0));
      all.push(...(corners || ends));
    });
    return all.length ? bounds(all) : { low: [0, 0], high: [1, 1] };
  })();

  /* Of bodies that move, where they are at a time. */
  const movingAt = (ms) =>
    moving.map(({ machine, body }) => ({ machine, ...outline(body, frameOf(machine, body.on, ms)) }));

  /* Large bodies over everything. */
  const isBridge = ({ low, corners }) => low > OVERHEAD && corners !== undefined
    && [0, 1].some((i) => Math.max(...corners.map((c) => c[i])) - Math.min(...corners.map((c) => c[i])) > 2);

  return { OVERHEAD, still, movingAt, laneBand, floorOf, boxes, extent, isBridge };
})();
