'use strict';
/* The time line that the Gantt chart and the signals share: what part of the run is seen, and its axis. */

const Timeline = (() => {
  /* For the names at the left: less on a narrow screen, px. */
  const gutter = (width) => Math.min(Math.max(0.24 * width, 104), 168);
  const view = { from: 0, to: Math.max(Data.endMs, 1) };
  const listeners = [];
  /* So much is seen at least, ms. */
  const LEAST = 20;

  function show(from, to) {
    const span = Math.min(Math.max(to - from, LEAST), Math.max(Data.endMs, LEAST));
    view.from = Math.min(Math.max(from, 0), Math.max(Data.endMs - span, 0));
    view.to = view.from + span;
    listeners.forEach((listener) => listener());
  }

  function zoom(factor, around = Player.time()) {
    const centre = around < view.from || around > view.to ? (view.from + view.to) / 2 : around;
    show(centre - (centre - view.from) / factor, centre + (view.to - centre) / factor);
  }

  const x = (ms, width) => gutter(width) + ((ms - view.from) / (view.to - view.from)) * (width - gutter(width));
  const ms = (px, width) => view.from + ((px - gutter(width)) / (width - gutter(width))) * (view.to - view.from);

  const STEPS = [10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 15000, 30000, 60000, 120000, 300000, 600000,
    900000, 1800000, 3600000, 7200000, 14400000, 21600000];

  function ticks(width) {
    const step = STEPS.find((ms) => (ms / (view.to - view.from)) * (width - gutter(width)) >= 84) || 43200000;
    const all = [];
    for (let at = Math.ceil(view.from / step) * step; at <= view.to; at += step) all.push(at);
    return { all, decimals: step >= 1000 ? 0 : step >= 100 ? 1 : 2 };
  }

  /* The axis along the top, if that has a height, and lines down from it. */
  function axis(context, width, height, top) {
    const colours = Colours.get();
    const { all, decimals } = ticks(width);
    context.font = `11px ${colours.font}`;
    context.textBaseline = 'middle';
    context.textAlign = 'center';
    context.strokeStyle = colours.grid;
    context.lineWidth = 1;
    context.beginPath();
    for (const at of all) {
      const px = Math.round(x(at, width)) + 0.5;
      context.moveTo(px, top);
      context.lineTo(px, height);
    }
    context.stroke();
    context.fillStyle = colours.muted;
    for (const at of top ? all : []) {
      const text = clock(at, decimals), half = context.measureText(text).width / 2;
      context.fillText(text, Math.min(Math.max(x(at, width), gutter(width) + half), width - half - 2), top / 2);
    }
  }

  /* When a property was violated, in a run that shows it. */
  function violation(context, width, height) {
    const { violation } = Data.results;
    const px = violation ? x(violation.at_s * 1000, width) : -1;
    if (px < gutter(width) || px > width) return;
    context.strokeStyle = Colours.get().bad;
    context.lineWidth = 2;
    context.setLineDash([5, 3]);
    context.beginPath();
    context.moveTo(px, 0);
    context.lineTo(px, height);
    context.stroke();
    context.setLineDash([]);
  }

  /* Where the plan is. */
  function cursor(context, width, height) {
    const px = x(Player.time(), width);
    if (px >= gutter(width) && px <= width) {
      context.strokeStyle = Colours.get().accent;
      context.lineWidth = 1.5;
      context.beginPath();
      context.moveTo(px, 0);
      context.lineTo(px, height);
      context.stroke();
    }
    violation(context, width, height);
  }

  /* Pointer and wheel on a canvas of this time line; `press` is told where it was pressed without being moved. */
  function listen(canvas, press) {
    let grabbed = null;
    canvas.addEventListener('wheel', (event) => {
      if (event.ctrlKey || event.metaKey) {
        event.preventDefault();
        zoom(Math.exp(-event.deltaY / 300), ms(event.offsetX, canvas.clientWidth));
      } else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
        event.preventDefault();
        const by = (((event.deltaX || event.deltaY) / (canvas.clientWidth - gutter(canvas.clientWidth))) * (view.to - view.from));
        show(view.from + by, view.to + by);
      }
    }, { passive: false });
    canvas.addEventListener('pointerdown', (event) => {
      grabbed = { x: event.offsetX, y: event.offsetY, from: view.from, to: view.to, isMoved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!grabbed) return;
      const by = event.offsetX - grabbed.x;
      if (Math.abs(by) > 4) grabbed.isMoved = true;
      if (!grabbed.isMoved) return;
      const span = grabbed.to - grabbed.from;
      const shift = (-by / (canvas.clientWidth - gutter(canvas.clientWidth))) * span;
      show(grabbed.from + shift, grabbed.to + shift);
    });
    canvas.addEventListener('pointerup', (event) => {
      if (grabbed && !grabbed.isMoved) {
        press(event.offsetX, event.offsetY);
        if (event.offsetX >= gutter(canvas.clientWidth)) Player.seek(ms(event.offsetX, canvas.clientWidth));
      }
      grabbed = null;
    });
    canvas.addEventListener('dblclick', (event) => zoom(3, ms(event.offsetX, canvas.clientWidth)));
  }

  /* Text that is too long ends in dots. */
  function clipped(context, text, width) {
    if (context.measureText(text).width <= width) return text;
    let end = text.length;
    while (end > 1 && context.measureText(text.slice(0, end) + '…').width > width) end--;
    return end > 1 ? text.slice(0, end) + '…' : '';
  }

  /* Text that is too long has dots in its middle: names often differ at their ends. */
  function squeezed(context, text, width) {
    if (context.measureText(text).width <= width) return text;
    let kept = text.length - 1;
    const short = () => `${text.slice(0, Math.ceil(kept / 2))}…${text.slice(text.length - Math.floor(kept / 2))}`;
    while (kept > 2 && context.measureText(short()).width > width) kept--;
    return short();
  }

  return { gutter, view, show, zoom, x, ms, axis, cursor, listen, clipped, squeezed, onChange: (f) => listeners.push(f) };
})();
