'use strict';
/* Signals as a logic analyser shows them: those that were chosen by name, on the time line of the Gantt chart. */

const Signals = (() => {
  const { gutter, view, x, clipped, squeezed } = Timeline;
  const ROW = 30, WAVE = 18;
  const canvas = byId('signals'), search = byId('signal-name'), list = byId('signal-list');
  const MOST_FOUND = 60;
  let chosen = [];

  /* What shows something of a line at first: sensors and grippers that change. */
  function first() {
    const changes = (signal) => Data.raw.changes[signal.number].length > 2;
    const isTold = (signal) => signal.form === 'truth' && signal.group === 'input' && changes(signal);
    const found = Data.signals.filter(isTold).filter((signal) => !/\.(ready|moving)$/.test(signal.name));
    const seen = new Set();
    chosen = found.filter(({ machine }) => !seen.has(machine) && seen.add(machine)).slice(0, 5);
    chosen.unshift(...Data.signals.filter(({ name }) => name === 'running'));
  }

  const isNumber = ({ form }) => form === 'real' || form === 'continuous';

  function truth(context, { at, value }, y, end, width) {
    const colours = Colours.get();
    const level = (v) => (v ? y : y + WAVE);
    const first = Math.max(0, Data.indexAt(at, view.from));
    let i = first;
    context.beginPath();
    context.moveTo(Math.max(x(at[i], width), gutter(width)), level(value[i]));
    let pixel = -1;
    const high = [];
    for (; i < at.length && at[i] < view.to; i++) {
      const from = Math.max(x(at[i], width), gutter(width));
      const to = i + 1 < at.length ? Math.min(x(at[i + 1], width), end) : end;
      if (value[i]) high.push([from, to]);
      // More than one edge in a pixel is one line.
      if (to - from < 0.5 && Math.floor(from) === pixel) continue;
      pixel = Math.floor(from);
      // An edge only where it changes in view.
      if (i > first) context.lineTo(from, level(!value[i]));
      context.lineTo(from, level(value[i]));
      context.lineTo(to, level(value[i]));
    }
    context.strokeStyle = colours.wave;
    context.lineWidth = 1.25;
    context.stroke();
    context.fillStyle = colours.wave;
    context.globalAlpha = 0.16;
    high.forEach(([from, to]) => context.fillRect(from, y, Math.max(to - from, 0.5), WAVE));
    context.globalAlpha = 1;
  }

  function bus(context, signal, { at, value }, y, end, width) {
    const colours = Colours.get();
    context.strokeStyle = colours.wave;
    context.lineWidth = 1.25;
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    context.font = `11px ${colours.font}`;
    let pixel = -1;
    for (let i = Math.max(0, Data.indexAt(at, view.from)); i < at.length && at[i] < view.to; i++) {
      const from = Math.max(x(at[i], width), gutter(width));
      const to = i + 1 < at.length ? Math.min(x(at[i + 1], width), end) : end;
      if (to <= from) continue;
      if (to - from < 1.5) {
        if (Math.floor(from) !== pixel) context.fillRect(Math.floor(from), y, 1, WAVE);
        pixel = Math.floor(from);
        context.fillStyle = colours.wave;
        continue;
      }
      const slope = Math.min(3, (to - from) / 2);
      context.beginPath();
      context.moveTo(from, y + WAVE / 2);
      context.lineTo(from + slope, y);
      context.lineTo(to - slope, y);
      context.lineTo(to, y + WAVE / 2);
      context.lineTo(to - slope, y + WAVE);
      context.lineTo(from + slope, y + WAVE);
      context.closePath();
      context.stroke();
      context.fillStyle = colours.ink;
      const text = clipped(context, Data.valueText(signal, value[i]), to - from - 10);
      if (text) context.fillText(text, from + 6, y + WAVE / 2 + 0.5);
    }
  }

  /* Numbers that change while something moves are known where something happened, and joined by lines between; all others
     hold until they change. */
  function real(context, signal, { at, value }, y, width) {
    const colours = Colours.get();
    let low = Infinity, high = -Infinity;
    for (const v of value) {
      low = Math.min(low, v);
      high = Math.max(high, v);
    }
    const level = (v) => y + WAVE - (high > low ? (v - low) / (high - low) : 0.5) * WAVE;
    const begin = Math.max(0, Data.indexAt(at, view.from));
    context.save();
    context.beginPath();
    context.rect(gutter(width), y - 2, width - gutter(width), WAVE + 4);
    context.clip();
    context.beginPath();
    for (let i = begin; i < at.length; i++) {
      const px = x(at[i], width);
      if (i === begin) context.moveTo(px, level(value[i]));
      else if (signal.form === 'real') context.lineTo(px, level(value[i - 1]));
      context.lineTo(px, level(value[i]));
      if (at[i] > view.to) break;
    }
    if (at[at.length - 1] <= view.to) context.lineTo(x(Data.knownUntil(signal), width), level(value[value.length - 1]));
    context.strokeStyle = colours.wave;
    context.lineWidth = 1.25;
    context.stroke();
    context.restore();
    context.font = `9px ${colours.font}`;
    context.textAlign = 'right';
    context.fillStyle = colours.muted;
    const short = (v) => String(Math.round(v * 1000) / 1000);
    context.fillText(short(high), gutter(width) - 22, y + 3);
    if (high > low) context.fillText(short(low), gutter(width) - 22, y + WAVE - 2);
  }

  function draw() {
    const colours = Colours.get();
    const width = canvas.parentElement.clientWidth, height = Math.max(ROW * chosen.length, 1);
    if (!width) return;
    const context = fitted(canvas, width, height);
    context.clearRect(0, 0, width, height);
    Timeline.axis(context, width, height, 0);
    chosen.forEach((signal, row) => {
      const y = row * ROW + (ROW - WAVE) / 2;
      const changes = Data.changes(signal.number);
      if (changes.at.length) {
        const end = Math.min(x(Data.knownUntil(signal), width), width);
        if (signal.form === 'truth') truth(context, changes, y, end, width);
        else if (isNumber(signal)) real(context, signal, changes, y, width);
        else bus(context, signal, changes, y, end, width);
      }
      context.fillStyle = colours.panel;
      context.fillRect(0, row * ROW, gutter(width) - (isNumber(signal) ? 60 : 0), ROW);
      context.font = `12px ${colours.font}`;
      context.textAlign = 'left';
      context.textBaseline = 'middle';
      context.fillStyle = colours.ink;
      context.fillText(squeezed(context, signal.name, gutter(width) - (isNumber(signal) ? 82 : 40)), 8, y + WAVE / 2);
      context.fillStyle = colours.muted;
      context.fillText('×', gutter(width) - 18, y + WAVE / 2);
      context.fillStyle = colours.grid;
      context.fillRect(0, (row + 1) * ROW - 1, width, 1);
    });
    Timeline.cursor(context, width, height);
  }

  function add(signal) {
    if (!chosen.includes(signal)) chosen.push(signal);
    Player.redraw();
  }

  function remove(signal) {
    chosen = chosen.filter((other) => other !== signal);
    Player.redraw();
  }

  function find() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    list.replaceChildren();
    list.hidden = !words.length;
    if (!words.length) return;
    const found = Data.signals.filter(({ name }) => words.every((word) => name.toLowerCase().includes(word)));
    for (const signal of found.slice(0, MOST_FOUND)) {
      const isShown = chosen.includes(signal);
      const entry = element('button', 'entry', element('span', '', signal.name), element('span', 'muted', isShown ? 'shown: remove' : signal.group));
      entry.addEventListener('click', () => {
        if (isShown) remove(signal);
        else add(signal);
        search.value = '';
        find();
      });
      list.append(entry);
    }
    const rest = found.length - MOST_FOUND;
    if (!found.length) list.append(element('p', 'muted', 'no signal of this name'));
    if (rest > 0) list.append(element('p', 'muted', `and ${rest} more: type more of the name`));
  }

  function listen() {
    first();
    search.addEventListener('input', find);
    search.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && list.querySelector('button')) list.querySelector('button').click();
      if (event.key === 'Escape') {
        search.value = '';
        find();
      }
    });
    Timeline.listen(canvas, (px, py) => {
      const right = gutter(canvas.clientWidth);
      if (px < right && px > right - 28) {
        chosen.splice(Math.floor(py / ROW), 1);
        Player.redraw();
      }
    });
  }

  return { draw, listen, add, chosen: () => chosen };
})();
