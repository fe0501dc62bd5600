'use strict';
/* The clock of the page, its buttons and keys, and who is drawn when. */

const Player = (() => {
  /* Of the clock between two frames, ms. */
  const MOST_PASSED = 250;
  const chosen = { machine: null, item: null };
  let now = 0, isPlaying = false, last = null, isAsked = false;

  const play = byId('play'), slider = byId('slider'), speed = byId('speed');

  function draw() {
    isAsked = false;
    Plan.draw(now);
    Gantt.draw();
    Signals.draw();
    Inspector.draw(now);
    byId('now').textContent = clock(now);
    slider.value = String(now);
    slider.setAttribute('aria-valuetext', clock(now));
  }

  function redraw() {
    if (!isAsked) requestAnimationFrame(frame);
    isAsked = true;
  }

  function frame(stamp) {
    if (isPlaying) {
      // A page that was hidden goes on where it was.
      const passed = last === null ? 0 : Math.min(stamp - last, MOST_PASSED);
      now = Math.min(now + passed * Number(speed.value), Data.endMs);
      last = stamp;
      if (now >= Data.endMs) pause();
      else {
        isAsked = true;
        requestAnimationFrame(frame);
      }
      follow();
    }
    const again = isPlaying;
    draw();
    isAsked = again;
  }

  /* The time line goes on when the plan has left it. */
  function follow() {
    const { from, to } = Timeline.view;
    if (now > to || now < from) Timeline.show(now - (to - from) * 0.1, now + (to - from) * 0.9);
  }

  function start() {
    if (now >= Data.endMs) now = 0;
    isPlaying = true;
    last = null;
    play.textContent = 'Pause';
    play.setAttribute('aria-pressed', 'true');
    redraw();
  }

  function pause() {
    isPlaying = false;
    play.textContent = 'Play';
    play.setAttribute('aria-pressed', 'false');
  }

  function seek(ms) {
    now = Math.min(Math.max(ms, 0), Data.endMs);
    follow();
    redraw();
  }

  /* To the next time at which something happens, or to the one before. */
  function step(direction) {
    const times = Data.eventTimes(chosen.machine);
    const index = Data.indexAt(times, now);
    const next = direction > 0 ? index + 1 : times[index] === now ? index - 1 : index;
    pause();
    if (next >= 0 && next < times.length) seek(times[next]);
  }

  function choose({ machine = null, item = null }) {
    Object.assign(chosen, { machine, item });
    redraw();
  }

  const KEYS = {
    ' ': () => (isPlaying ? pause() : start()),
    n: () => step(1),
    p: () => step(-1),
    ArrowRight: () => seek(now + 1000),
    ArrowLeft: () => seek(now - 1000),
    Home: () => seek(0),
    End: () => seek(Data.endMs),
    '+': () => Timeline.zoom(2),
    '=': () => Timeline.zoom(2),
    '-': () => Timeline.zoom(0.5),
    Escape: () => choose({}),
  };

  function listen() {
    slider.max = String(Data.endMs);
    slider.addEventListener('input', () => seek(Number(slider.value)));
    play.addEventListener('click', () => (isPlaying ? pause() : start()));
    byId('next').addEventListener('click', () => step(1));
    byId('before').addEventListener('click', () => step(-1));
    byId('end').textContent = clock(Data.endMs);
    document.addEventListener('keydown', (event) => {
      const own = ['INPUT', 'SELECT', 'TEXTAREA'].includes(event.target.tagName) && event.target !== slider;
      const key = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (own || !key || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
      // It presses what has the focus.
      if (event.key === ' ' && ['BUTTON', 'SUMMARY', 'A'].includes(event.target.tagName)) return;
      event.preventDefault();
      key();
    });
    window.addEventListener('resize', resize);
    new ResizeObserver(resize).observe(byId('plan').parentElement);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      Colours.read();
      redraw();
    });
    Timeline.onChange(redraw);
  }

  function resize() {
    Plan.resize();
    redraw();
  }

  function begin() {
    Figures.draw();
    Tables.draw();
    Plan.listen();
    Gantt.listen();
    Signals.listen();
    listen();
    Plan.resize();
    if (Data.results.violation) seek(Data.results.violation.at_s * 1000);
    draw();
    document.documentElement.dataset.drawn = String(Math.round(performance.now()));
  }

  return {
    chosen, choose, seek, step, start, pause, redraw, draw, begin, time: () => now, isPlaying: () => isPlaying,
  };
})();

Player.begin();
