'use strict';
/* The Gantt chart: a row for each machine, its states by name, coloured by what it is counted as. */

const Gantt = (() => {
  const { gutter, view, x, clipped, squeezed } = Timeline;
  const ROW = 22, TOP = 24, BAR = 16;
  const canvas = byId('gantt'), box = byId('gantt-box');
  let isOnPaper = false;
  /* Of each machine the parts of the path that limits the run: begin and end, in order. */
  const path = Data.machines.map(() => []);
  for (const [machine, begin, end] of Data.raw.path) path[machine].push([begin * Data.scanMs, end * Data.scanMs]);

  /* Stays too short to be seen share a column of pixels by their times. */
  function column(context, px, y, shares) {
    const colours = Colours.get();
    const whole = shares.reduce((sum, share) => sum + share, 0);
    let top = y;
    shares.forEach((share, i) => {
      const height = (share / whole) * BAR;
      context.fillStyle = colours[Data.KINDS[i]];
      context.fillRect(px, top, 1, height);
      top += height;
    });
  }

  /* What is as light as the ground has edges. */
  function edge(context, px, y, width) {
    context.fillStyle = Colours.get()['waiting-edge'];
    context.fillRect(px, y, width, 1);
    context.fillRect(px, y + BAR - 1, width, 1);
  }

  function row(context, machine, y, width) {
    const colours = Colours.get();
    const { at, state, counted } = Data.stays[machine];
    const first = Math.max(0, Data.indexAt(at, view.from));
    let pixel = -1, shares = null;
    const flush = () => {
      if (shares) column(context, pixel, y, shares);
      shares = null;
    };
    let name = null;
    const write = () => {
      if (!name || name.to - name.from < 26) return;
      context.fillStyle = colours['on-' + name.counted];
      const text = clipped(context, Data.stateName(machine, name.state), name.to - name.from - 8);
      if (text) context.fillText(text, name.from + 4, y + BAR / 2 + 0.5);
    };
    for (let i = first; i < at.length && at[i] < view.to; i++) {
      const begin = Math.max(at[i], view.from);
      const end = Math.min(i + 1 < at.length ? at[i + 1] : Data.endMs, view.to);
      const [from, to] = [x(begin, width), x(end, width)];
      const kind = Data.KINDS[counted[i]];
      if (to - from < 1.5) {
        if (Math.floor(from) !== pixel || !shares) {
          flush();
          pixel = Math.floor(from);
          shares = Data.KINDS.map(() => 0);
        }
        shares[counted[i]] += end - begin;
        write();
        name = null;
        continue;
      }
      flush();
      context.fillStyle = colours[kind];
      context.fillRect(from, y, to - from, BAR);
      if (kind === 'waiting') edge(context, from, y, to - from);
      // The begin of a state is told from what comes before.
      if (i > first && state[i] !== state[i - 1] && to - from > 4) {
        context.fillStyle = colours.panel;
        context.fillRect(from, y, 1, BAR);
      }
      if (name && name.state === state[i] && name.counted === kind) name.to = to;
      else {
        write();
        name = { state: state[i], counted: kind, from, to };
      }
    }
    write();
    flush();
    marks(context, machine, y, width);
    limits(context, machine, y, width);
  }

  /* Transitions to the same state, as far as they can be told apart. */
  function marks(context, machine, y, width) {
    const again = Data.again[machine];
    context.fillStyle = Colours.get().panel;
    let last = -Infinity;
    for (let i = Data.indexAt(again, view.from) + 1; i < again.length && again[i] < view.to; i++) {
      const px = x(again[i], width);
      if (px - last > 4) context.fillRect(px, y, 1, BAR);
      last = px;
    }
  }

  function limits(context, machine, y, width) {
    const legs = path[machine];
    context.fillStyle = Colours.get().path;
    let low = 0, high = legs.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (legs[middle][1] < view.from) low = middle + 1;
      else high = middle;
    }
    for (let i = low; i < legs.length && legs[i][0] < view.to; i++) {
      const from = Math.max(x(legs[i][0], width), gutter(width)), to = Math.min(x(legs[i][1], width), width);
      context.fillRect(from, y + BAR, Math.max(to - from, 0.5), 2.5);
    }
  }

  function draw() {
    const colours = Colours.get();
    const whole = TOP + ROW * Data.machines.length + 4;
    // At most about half of the window: the rest is scrolled.
    box.style.height = (isOnPaper ? whole : Math.min(whole, Math.max(0.46 * innerHeight, 200))) + 'px';
    const width = box.clientWidth, height = box.clientHeight;
    if (!width) return;
    byId('gantt-room').style.height = Math.max(whole - height, 0) + 'px';
    const context = fitted(canvas, width, height);
    context.clearRect(0, 0, width, height);
    Timeline.axis(context, width, height, TOP);
    const scrolled = box.scrollTop;
    context.save();
    context.beginPath();
    context.rect(0, TOP, width, height - TOP);
    context.clip();
    Data.machines.forEach((machine, i) => {
      const y = TOP + i * ROW - scrolled + 2;
      if (y + ROW < TOP || y > height) return;
      const isChosen = machine.number === Player.chosen.machine;
      if (isChosen) {
        context.fillStyle = colours.grid;
        context.fillRect(0, y - 2, width, ROW);
      }
      context.font = `${isChosen ? 600 : 400} 12px ${colours.font}`;
      context.textAlign = 'left';
      context.textBaseline = 'middle';
      context.fillStyle = colours.ink;
      context.fillText(squeezed(context, machine.name, gutter(width) - 16), 8, y + BAR / 2 + 1);
      context.font = `11px ${colours.font}`;
      row(context, machine.number, y, width);
    });
    context.restore();
    Timeline.cursor(context, width, height);
  }

  function listen() {
    box.addEventListener('scroll', draw);
    for (const [name, is] of [['beforeprint', true], ['afterprint', false]]) {
      window.addEventListener(name, () => {
        isOnPaper = is;
        draw();
      });
    }
    Timeline.listen(canvas, (px, py) => {
      const number = Math.floor((py - TOP + box.scrollTop) / ROW);
      if (py > TOP && Data.machines[number]) Player.choose({ machine: number });
    });
    canvas.addEventListener('pointermove', (event) => {
      const number = Math.floor((event.offsetY - TOP + box.scrollTop) / ROW);
      const machine = event.offsetY > TOP ? Data.machines[number] : null;
      const isName = event.offsetX < gutter(canvas.clientWidth);
      canvas.title = !machine ? '' : isName ? machine.name : about(machine, Timeline.ms(event.offsetX, canvas.clientWidth));
    });
    canvas.addEventListener('keydown', (event) => {
      const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      const { machine } = Player.chosen, count = Data.machines.length;
      const number = machine === null ? (by > 0 ? 0 : count - 1) : Math.min(Math.max(machine + by, 0), count - 1);
      box.scrollTop = Math.min(Math.max(box.scrollTop, TOP + (number + 1) * ROW - box.clientHeight), number * ROW);
      Player.choose({ machine: number });
    });
    byId('time-in').addEventListener('click', () => Timeline.zoom(2));
    byId('time-out').addEventListener('click', () => Timeline.zoom(0.5));
    byId('time-fit').addEventListener('click', () => Timeline.show(0, Data.endMs));
  }

  function about(machine, ms) {
    const stay = Data.stayAt(machine.number, ms);
    const until = stay.nextMs === null ? Data.endMs : stay.nextMs;
    const name = Data.stateName(machine.number, stay.state);
    return `${machine.name}: ${name}, ${stay.counted}\n${clock(stay.sinceMs)} to ${clock(until)} (${seconds((until - stay.sinceMs) / 1000)} s)`;
  }

  return { draw, listen };
})();
