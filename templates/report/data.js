'use strict';
/* What the page shows, decoded. Times are milliseconds from the start of the run, places metres in the world. */

const Data = (() => {
  const raw = JSON.parse(document.getElementById('data').textContent);
  const scanMs = raw.scan_ms;
  const endMs = raw.results.simulated_s * 1000;
  const COUNTED = ['moving', 'working', 'waiting', 'stopped'];

  /* Of each machine: from when on, in which state, counted as what. */
  const stays = raw.stays.map((list) => {
    const count = list.length / 3;
    const at = new Float64Array(count), state = new Uint16Array(count), counted = new Uint8Array(count);
    for (let i = 0, scan = 0; i < count; i++) {
      scan += list[3 * i];
      at[i] = scan * scanMs;
      state[i] = list[3 * i + 1];
      counted[i] = list[3 * i + 2];
    }
    return { at, state, counted };
  });

  const machines = raw.machines.map((machine, number) => ({
    ...machine,
    number,
    automaton: raw.automata[raw.types[number]],
    account: raw.results.robots[machine.name],
  }));

  const signals = raw.signals.rows.map(([name, machine, group, form], number) => {
    const shape = raw.signals.forms[form];
    const names = Array.isArray(shape) ? shape : null;
    return { number, name, machine, group, names, form: names ? 'names' : shape };
  });

  const decoded = new Map();
  /* When a signal changed, and to what. */
  function changes(number) {
    if (!decoded.has(number)) {
      const list = raw.changes[number], count = list.length / 2;
      const at = new Float64Array(count), value = new Float64Array(count);
      for (let i = 0, scan = 0; i < count; i++) {
        scan += list[2 * i];
        at[i] = scan * scanMs;
        value[i] = list[2 * i + 1];
      }
      decoded.set(number, { at, value });
    }
    return decoded.get(number);
  }

  /* The last index whose time is not after this one; -1 before all of them. */
  function indexAt(at, ms) {
    let low = 0, high = at.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (at[middle] <= ms) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  function valueAt(number, ms) {
    const { at, value } = changes(number);
    const index = indexAt(at, ms);
    return index < 0 ? null : value[index];
  }

  function valueText(signal, value) {
    if (value === null) return '–';
    if (signal.form === 'truth') return value ? 'true' : 'false';
    if (signal.form === 'names') return signal.names[value] || String(value);
    return signal.form === 'real' ? String(Math.round(value * 1e4) / 1e4) : String(value);
  }

  /* The stay of a machine at a time. */
  function stayAt(machine, ms) {
    const { at, state, counted } = stays[machine];
    const index = Math.max(0, indexAt(at, ms));
    let begin = index, next = index + 1;
    while (begin > 0 && state[begin - 1] === state[index]) begin--;
    while (next < at.length && state[next] === state[index]) next++;
    return {
      index,
      state: state[index] || 0,
      counted: COUNTED[counted[index]] || 'stopped',
      sinceMs: at[begin] || 0,
      nextMs: next < at.length ? at[next] : null,
      nextState: next < at.length ? state[next] : null,
    };
  }

  function stateName(machine, state) {
    const found = machines[machine].automaton.states[state];
    return found ? found.name : '';
  }

  /* All times at which something happens, of one machine or of all. */
  const events = new Map();
  function eventTimes(machine) {
    if (!events.has(machine)) {
      const times = new Set();
      const all = machine === null ? stays : [stays[machine]];
      for (const { at } of all) for (const ms of at) times.add(ms);
      if (machine === null) for (const path of raw.paths) for (let i = 1; i < path.length; i++) {
        if (i === 1 || path[i][1] !== path[i - 1][1]) times.add(path[i][0]);
      }
      events.set(machine, Float64Array.from(times).sort());
    }
    return events.get(machine);
  }

  return {
    raw, scanMs, endMs, COUNTED, stays, machines, signals, results: raw.results,
    changes, indexAt, valueAt, valueText, stayAt, stateName, eventTimes,
  };
})();

/* A time as the axis shows it: h:mm:ss once there are minutes, with the decimals that are asked for. */
function clock(ms, decimals = 2) {
  const unit = 10 ** decimals;
  const total = Math.round((ms / 1000) * unit) / unit;
  if (Data.endMs < 600000) return total.toFixed(decimals) + ' s';
  const whole = Math.floor(total), rest = (total - whole).toFixed(decimals).slice(1);
  const two = (n) => String(n).padStart(2, '0');
  const minutes = `${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return (Data.endMs < 3600000 ? minutes : `${Math.floor(whole / 3600)}:${minutes}`) + rest;
}

function seconds(s, decimals = 2) {
  return s === null || s === undefined ? '–' : s.toFixed(decimals);
}

/* The colours of the page as its style has them at present. */
const Colours = (() => {
  let known = {};
  function read() {
    const style = getComputedStyle(document.documentElement);
    known = {};
    for (const name of ['bg', 'panel', 'ink', 'muted', 'line', 'grid', 'accent', 'bad', 'moving', 'working',
      'waiting', 'stopped', 'on-moving', 'on-working', 'on-waiting', 'on-stopped', 'solid', 'solid-edge', 'lane',
      'lane-edge', 'wave', 'path']) known[name] = style.getPropertyValue('--' + name).trim();
    known.kinds = Array.from({ length: 8 }, (_, i) => style.getPropertyValue('--kind-' + i).trim());
    known.font = style.getPropertyValue('--font').trim();
  }
  read();
  return { get: () => known, read };
})();

/* A canvas that has the pixels of the screen; gives its context in CSS pixels. */
function fitted(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  canvas.style.width = width + 'px';
  canvas.style.height = height + 'px';
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}
