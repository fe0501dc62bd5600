'use strict';
/* Where everything is at a time: the laws of the run itself, not samples of it.

   A pose is twelve numbers: the rows of its rotation, then its position. */

const Motion = (() => {
  const { raw, indexAt } = Data;
  const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];

  function then(a, b) {
    const r = new Array(12);
    for (let i = 0; i < 3; i++) {
      const [x, y, z] = [a[3 * i], a[3 * i + 1], a[3 * i + 2]];
      for (let j = 0; j < 3; j++) r[3 * i + j] = x * b[j] + y * b[3 + j] + z * b[6 + j];
      r[9 + i] = a[9 + i] + (x * b[9] + y * b[10] + z * b[11]);
    }
    return r;
  }

  function point(a, [x, y, z]) {
    return [0, 1, 2].map((i) => a[9 + i] + (a[3 * i] * x + a[3 * i + 1] * y + a[3 * i + 2] * z));
  }

  function turned(angle, position = [0, 0, 0]) {
    const [s, c] = [Math.sin(angle), Math.cos(angle)];
    return [c, -s, 0, s, c, 0, 0, 0, 1, ...position];
  }

  function shifted(position) {
    return [1, 0, 0, 0, 1, 0, 0, 0, 1, ...position];
  }

  const radians = (degrees) => (degrees * Math.PI) / 180;

  /* Rows of so many numbers each, the first of which is a time. */
  function rows(list, width) {
    const at = new Float64Array(list.length / width);
    for (let i = 0; i < at.length; i++) at[i] = list[width * i];
    return { at, list, width };
  }

  const machines = raw.motions.map((motion) => ({
    start: motion.start,
    joints: motion.joints,
    swings: rows(motion.swings, 3),
    drives: rows(motion.drives, 9),
    rides: rows(motion.rides, 9),
    strokes: new Map(motion.strokes.map(([part, list]) => [part, rows(list, 4)])),
    surfaces: new Map(motion.surfaces.map(([part, list]) => [part, rows(list, 2)])),
  }));

  /* The place on the path of a trajectory, 0 to 1, so many seconds after its begin. */
  function placeOn([place, speed, ...phases], s) {
    for (let i = 0; i < phases.length; i += 2) {
      const [duration, gain] = [phases[i], phases[i + 1]];
      const passed = Math.min(Math.max(s, 0), duration);
      if (s < duration) return Math.min(Math.max(place + (speed + (gain * passed) / 2) * passed, 0), 1);
      place += (speed + (gain * duration) / 2) * duration;
      speed += gain * duration;
      s -= duration;
    }
    return place > 1 - 1e-6 ? 1 : place;
  }

  /* Numbers of which each was written by how much its distance from the last one differs from the distance before. */
  function straightened(bends, unit) {
    let last = 0, step = 0;
    return bends.map((bend) => {
      step += bend;
      last += step;
      return last / unit;
    });
  }

  const trajectories = new Map();
  /* A trajectory of an arm: what the place on its path does, and that path. */
  function trajectoryOf(number) {
    if (!trajectories.has(number)) {
      const [place, places, halves, ...joints] = raw.trajectories[number];
      const list = (of, unit) => (Array.isArray(of) ? straightened(of, unit) : of);
      trajectories.set(number, [place, list(places, 1e8), list(halves, 1e8), ...joints.map((joint) => list(joint, 1e7))]);
    }
    return trajectories.get(number);
  }

  /* The joints at a place on a path: lines from knot to knot, and a parabola over each corner. */
  function onPath([, places, halves, ...joints], place) {
    if (places === 0) return joints.map((of) => (Array.isArray(of) ? of[0] + place * (of[1] - of[0]) : of));
    const last = places.length - 2;
    const of = (joint, knot) => (Array.isArray(joint) ? joint[knot] : joint);
    if (place <= 0) return joints.map((joint) => of(joint, 0));
    if (place >= 1) return joints.map((joint) => of(joint, last + 1));
    const after = Math.min(Math.max(indexAt(places, place) + 1, 1), last + 1);
    let line = after - 1, corner = null;
    if (place > places[after] - halves[after]) [corner, line] = [after, after - 1];
    else if (place < places[line] + halves[line]) [corner, line] = [line, line - 1];
    return joints.map((joint) => {
      if (!Array.isArray(joint)) return joint;
      const rate = (knot) => (joint[knot + 1] - joint[knot]) / (places[knot + 1] - places[knot]);
      const value = joint[line] + (place - places[line]) * rate(line);
      if (corner === null) return value;
      const beyond = Math.max(place - (places[corner] - halves[corner]), 0);
      return value + ((beyond * beyond) / (4 * halves[corner])) * (rate(corner) - rate(line));
    });
  }

  function jointsBy(machine, index, ms) {
    const { joints, swings } = machines[machine];
    if (index < 0) return joints;
    const [begin, after, trajectory] = swings.list.slice(3 * index, 3 * index + 3);
    // It was let go where it was.
    if (trajectory < 0) return jointsBy(machine, index - 1, begin);
    const found = trajectoryOf(trajectory);
    return onPath(found, placeOn(found[0], (ms - begin - after) / 1000));
  }

  /* The joints of an arm: rails in m, then angles in rad. */
  function jointsAt(machine, ms) {
    return jointsBy(machine, indexAt(machines[machine].swings.at, ms), ms);
  }

  const memory = { ms: null, frames: new Map() };
  /* The frames of the links of an arm. */
  function framesAt(machine, ms) {
    if (memory.ms !== ms) {
      memory.ms = ms;
      memory.frames.clear();
    }
    if (!memory.frames.has(machine)) {
      const joints = jointsAt(machine, ms), frames = [];
      let frame = IDENTITY;
      Data.machines[machine].links.forEach((link, i) => {
        const value = joints[i];
        const moved = link.joint === 'turns' ? turned(value) : shifted(['x', 'y', 'z'].map((axis) => (axis === link.joint ? value : 0)));
        frame = then(then(then(frame, link.before), moved), link.behind);
        frames.push(frame);
      });
      memory.frames.set(machine, frames);
    }
    return memory.frames.get(machine);
  }

  /* The piece of its track that a vehicle is on, and seconds since it began. */
  function rideAt(machine, ms) {
    const { rides } = machines[machine];
    const index = indexAt(rides.at, ms);
    if (index < 0) return null;
    const piece = rides.list.slice(9 * index, 9 * index + 9);
    return { piece, s: (Math.min(ms, piece[1]) - piece[0]) / 1000 };
  }

  /* How a vehicle is turned, rad. */
  function headingAt(machine, ms) {
    const ride = rideAt(machine, ms);
    return radians(ride ? ride.piece[4] : machines[machine].start[3] || 0);
  }

  /* Where a vehicle is. */
  function positionAt(machine, ms) {
    const { start, drives } = machines[machine];
    const ride = rideAt(machine, ms);
    if (ride) {
      const { piece: [, , x, y, , vx, vy, ax, ay], s } = ride;
      return [x + (vx + (ax * s) / 2) * s, y + (vy + (ay * s) / 2) * s, start[2]];
    }
    const index = indexAt(drives.at, ms);
    if (index < 0) return start;
    const [begin, x, y, z, vx, vy, vz, from, until] = drives.list.slice(9 * index, 9 * index + 9);
    const sets = Math.max(begin, from);
    const s = Math.max(0, Math.min(ms, until) - sets) / 1000;
    return [x + vx * s, y + vy * s, z + vz * s];
  }

  /* The part of a stroke after so many seconds, which stops at a part of it. */
  function goneOut(out, rate, until, s) {
    return Math.min(Math.max(out + rate * s, Math.min(out, until)), Math.max(out, until));
  }

  /* The part of its stroke that a cylinder or a positioner is out. */
  function outAt(machine, part, ms) {
    const track = machines[machine].strokes.get(part);
    const index = track ? indexAt(track.at, ms) : -1;
    if (index < 0) return 0;
    const [begin, out, rate, until] = track.list.slice(4 * index, 4 * index + 4);
    return goneOut(out, rate, until, (ms - begin) / 1000);
  }

  /* What is on a cylinder, from where it is at the inner end. */
  function strokeFrame({ stroke }, out) {
    if (stroke.slides) return shifted(stroke.slides.map((far) => far * out));
    const [x, y, z] = stroke.pivot;
    return then(turned(radians(stroke.degrees * out), [x, y, z]), shifted([-x, -y, -z]));
  }

  const cylinderOf = (machine, part) => Data.machines[machine].cylinders.find((cylinder) => cylinder.part === part);

  function cylinderFrame(machine, part, ms) {
    const cylinder = cylinderOf(machine, part);
    return cylinder && cylinder.stroke ? strokeFrame(cylinder, outAt(machine, part, ms)) : IDENTITY;
  }

  /* Metres that the surface of a conveyor has gone by a time. */
  function travelAt(machine, part, ms) {
    const track = machines[machine].surfaces.get(part);
    if (!track || !track.at.length) return 0;
    if (!track.gone) {
      track.gone = new Float64Array(track.at.length);
      for (let i = 1; i < track.at.length; i++) {
        track.gone[i] = track.gone[i - 1] + (track.list[2 * i - 1] * (track.at[i] - track.at[i - 1])) / 1000;
      }
    }
    const index = Math.max(0, indexAt(track.at, ms));
    return track.gone[index] + (track.list[2 * index + 1] * (ms - track.at[index])) / 1000;
  }

  /* A place on the middle line of a conveyor: point and heading, in rad. */
  function frameOn(line, place) {
    const { along, surface, from, length, rise, radius } = line;
    if (along === 'x') return turned(Math.PI, [place, surface[1], surface[2]]);
    if (along === 'y') return turned(-Math.PI / 2, [surface[0], place, surface[2]]);
    const gone = length - place;
    const height = rise * Math.min(Math.max(gone / length, 0), 1);
    const base = turned(radians(line.yaw), from);
    if (!radius) return then(base, shifted([gone, 0, height]));
    const onArc = Math.min(Math.max(gone, 0), length), angle = onArc / radius;
    const arc = turned(angle, [radius * Math.sin(angle), radius * (1 - Math.cos(angle)), height]);
    const frame = then(base, arc);
    return [...frame.slice(0, 9), ...point(frame, [gone - onArc, 0, 0])];
  }

  function pointOn(line, place, across) {
    const { along, surface } = line;
    if (along === 'x') return [place, surface[1] + across, surface[2]];
    if (along === 'y') return [surface[0] + across, place, surface[2]];
    return point(frameOn(line, place), [0, across, 0]);
  }

  const endsOf = (line) => line.range || [0, line.length];
  const laneOf = (machine, part) => Data.machines[machine].lanes.find((lane) => lane.part === part);
  const yawOf = (frame) => Math.atan2(frame[3], frame[0]);

  const carrierOf = (segment) => {
    const [text, what, machine, part] = raw.carriers[segment[1]];
    return { text, what, machine, part };
  };

  /* Segments that go on where the one before has brought the item are given the place. */
  function whole(segments) {
    segments.forEach((segment, i) => {
      if (segment[2] < 4) return;
      const place = placeBy(segments[i - 1], segment[0]);
      segments[i] = [segment[0], segment[1], segment[2] - 4, ...place, ...segment.slice(3)];
    });
    return segments;
  }

  const items = raw.paths.map((path, number) => {
    const [name, first, becomes, loads] = raw.items[number];
    const kinds = [[-Infinity, first], ...(becomes || [])];
    const segments = whole(path.slice(1));
    return { number, name, kinds, loads: loads || [], segments, at: Float64Array.from(segments, (s) => s[0]), endMs: path[0], turns: [], gripped: [] };
  });

  /* What an item is at a time: a process makes one kind of another. */
  function kindAt(item, ms) {
    const kinds = item.kinds.filter(([since]) => since <= ms);
    return raw.kinds[kinds[kinds.length - 1][1]];
  }

  /* Where the underside of an item is by the law of a segment. */
  function placeBy(segment, ms) {
    const [begin, , law, a, b, c, d, e, f, gx = 0, gy = 0, gz = 0] = segment;
    const s = (ms - begin) / 1000;
    const { machine, part } = carrierOf(segment);
    switch (law) {
      case 0: return [a, b, c];
      case 1: return [a + (d + (gx * s) / 2) * s, b + (e + (gy * s) / 2) * s, c + (f + (gz * s) / 2) * s];
      case 2: {
        if (carrierOf(segment).what === 'place') return point(carriedBy(segment, s), [a, b, c]);
        const { place, across, frame, offset: [ahead, left, up] } = conveyed(segment, s);
        const lies = point(frameOn(laneOf(machine, part).line, place), [ahead, across + left, up]);
        return frame ? point(frame, lies) : lies;
      }
      default: {
        const frames = framesAt(machine, ms);
        return point(frames[frames.length - 1], [a, b, c]);
      }
    }
  }

  /* How far an item has come on its conveyor, or the one under it from which it is so far, and how the conveyor has moved. */
  function conveyed([, carrier, , at, across, speed, stopsAt, out, rate, until, ...offset], s) {
    const [, , machine, part] = raw.carriers[carrier];
    const least = stopsAt === null ? -Infinity : Math.min(stopsAt, at);
    const place = Math.max(at - speed * s, least);
    const cylinder = out == null ? null : cylinderOf(machine, laneOf(machine, part).on);
    const frame = cylinder && strokeFrame(cylinder, goneOut(out, rate, until, s));
    return { place, across, frame, offset: offset.length ? offset : [0, 0, 0] };
  }

  /* How a cylinder has moved a place with an item. */
  function carriedBy([, carrier, , , , , , out, rate, until], s) {
    const [, , machine, part] = raw.carriers[carrier];
    const { on } = Data.machines[machine].places.find((place) => place.part === part);
    return strokeFrame(cylinderOf(machine, on), goneOut(out, rate, until, s));
  }

  /* How an item is turned, rad: it keeps its heading but on a conveyor with a frame, on a gripper and on another item. */
  function turnBy(item, index, ms) {
    const segment = item.segments[index];
    const load = item.loads.find(([from, to]) => from <= segment[0] && (to === null || segment[0] < to));
    if (load) {
      const [, , under, turn] = load;
      return turnBy(items[under], indexAt(items[under].at, ms), ms) + turn;
    }
    const { what, machine, part } = carrierOf(segment);
    if (what === 'lane') {
      const lane = laneOf(machine, part);
      if (segment[2] === 2 && !lane.line.along) {
        const { place, frame } = conveyed(segment, (ms - segment[0]) / 1000);
        return yawOf(frameOn(lane.line, place)) + (frame ? yawOf(frame) : 0);
      }
      if (lane.line.from && !lane.line.radius) {
        const carried = lane.on === null ? 0 : yawOf(cylinderFrame(machine, lane.on, ms));
        return radians(lane.line.yaw) + carried;
      }
    }
    const begin = turnAtBegin(item, index);
    if (what === 'place' && segment[2] === 2) {
      return begin + yawOf(carriedBy(segment, (ms - segment[0]) / 1000)) - yawOf(carriedBy(segment, 0));
    }
    if (what === 'place' && machines[machine].rides.at.length) {
      return begin + headingAt(machine, ms) - headingAt(machine, segment[0]);
    }
    if (what !== 'grip' || segment[2] !== 3) return begin;
    const tool = (at) => yawOf(framesAt(machine, at).slice(-1)[0]);
    const now = tool(ms);
    if (item.gripped[index] === undefined) item.gripped[index] = tool(segment[0]);
    return begin + now - item.gripped[index];
  }

  function turnAtBegin(item, index) {
    while (item.turns.length <= index) {
      const next = item.turns.length;
      item.turns.push(next === 0 ? 0 : turnBy(item, next - 1, item.segments[next][0]));
    }
    return item.turns[index];
  }

  /* Where an item is, how it is turned and what bears it; null while it is not on the line. */
  function itemAt(number, ms) {
    const item = items[number];
    const index = indexAt(item.at, ms);
    if (index < 0) return null;
    const segment = item.segments[index], carrier = carrierOf(segment);
    if (['sink', 'collector', 'part', 'order', 'supply'].includes(carrier.what)) return null;
    const until = Math.min(ms, item.endMs);
    return { place: placeBy(segment, until), turn: turnBy(item, index, until), carrier };
  }

  /* The end of what is drawn. */
  const drawnUntil = raw.drawn_until_s === null ? Infinity : raw.drawn_until_s * 1000;

  return {
    IDENTITY, drawnUntil, items, kindAt, then, point, turned, jointsAt, framesAt, positionAt, headingAt, cylinderFrame, strokeFrame,
    travelAt, frameOn,
    pointOn, endsOf, outAt, laneOf, itemAt, carrierOf, placeBy, yawOf,
  };
})();
