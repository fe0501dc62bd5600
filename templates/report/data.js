'use strict';
/* What the page shows, decoded. Times are milliseconds from the start of the run, places metres in the world. */

const Data = (() => {
  const raw = JSON.parse(document.getElementById('data').textContent);
  const scanMs = raw.scan_ms;
  const endMs = raw.results.simulated_s * 1000;
  const COUNTED = ['moving', 'working', 'waiting', 'stopped'];
  /* After the time up to which states are shown. */
  const KINDS = [...COUNTED, 'unknown'];
  const STOPPED = 3, UNKNOWN = 4;
  const decimals = scanMs % 10 ? 3 : 2;

  /* Times and values of a list of scans since the entry before, and values. */
  function pairs(list) {
    const count = list.length / 2;
    const at = new Float64Array(count), value = new Float64Array(count);
    for (let i = 0, scan = 0; i < count; i++) {
      scan += list[2 * i];
      at[i] = scan * scanMs;
      value[i] = list[2 * i + 1];
    }
    return { at, value };
  }

  /* Of each machine: from when on, in which state, counted as what; and scans before in which it was not stopped. */
  const stays = raw.stays.map((list) => {
    const count = list.length / 3;
    const at = new Float64Array(count), state = new Uint16Array(count), counted = new Uint8Array(count);
    const ran = new Float64Array(count);
    for (let i = 0, scan = 0; i < count; i++) {
      if (i) ran[i] = ran[i - 1] + (counted[i - 1] < STOPPED ? list[3 * i] : 0);
      scan += list[3 * i];
      at[i] = scan * scanMs;
      state[i] = list[3 * i + 1];
      counted[i] = list[3 * i + 2];
    }
    return { at, state, counted, ran };
  });

  /* Times in states that are not what the states say. */
  const times = raw.times.map(pairs);

  /* When each machine made a transition to the state in which it was. */
  const again = times.map(({ at, value }, machine) => {
    const { at: begins, counted } = stays[machine];
    return at.filter((ms, i) => value[i] === 0 && counted[indexAt(begins, ms)] < STOPPED);
  });

  /* When each machine entered a state, the same one too. */
  const entered = stays.map(({ at, state }, machine) => {
    const begins = at.filter((_, i) => i === 0 || state[i] !== state[i - 1]);
    return Float64Array.from([...begins, ...again[machine]]).sort();
  });

  const machines = raw.machines.map((machine, number) => ({
    ...machine,
    number,
    automaton: raw.automata[raw.types[number]],
    account: raw.results.robots[machine.name],
  }));

  const signals = raw.signals.rows.map(([name, machine, group, form, changesBetween], number) => {
    const shape = raw.signals.forms[form];
    const names = Array.isArray(shape) ? shape : null;
    return { number, name, machine, group, names, form: names ? 'names' : changesBetween ? 'continuous' : shape };
  });

  /* Times in states are known until then. */
  const timesUntil = raw.words_until_s === null ? endMs : raw.words_until_s * 1000;
  const wordsUntil = Math.min(...[raw.words_until_s, raw.signals_until_s].map((s) => (s === null ? endMs : s * 1000)));
  /* The end of what is known of a signal. */
  const knownUntil = (signal) => (signal.group === 'line' ? endMs : wordsUntil);

  const decoded = new Map();
  /* When a signal changed, and to what. */
  function changes(number) {
    if (!decoded.has(number)) decoded.set(number, pairs(raw.changes[number]));
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
    return index < 0 || ms > knownUntil(signals[number]) ? null : value[index];
  }

  function valueText(signal, value) {
    if (value === null) return '–';
    if (signal.form === 'truth') return value ? 'true' : 'false';
    if (signal.form === 'names') return signal.names[value] || String(value);
    return signal.form === 'whole' ? String(value) : String(Math.round(value * 1e4) / 1e4);
  }

  /* A value as text. One that changes while something moves is known where something happened; between, it is near a line. */
  function textAt(signal, ms) {
    const known = valueAt(signal.number, ms);
    if (signal.form !== 'continuous' || known === null) return valueText(signal, known);
    const { at, value } = changes(signal.number);
    const index = indexAt(at, ms), scan = Math.floor(ms / scanMs + 1e-6) * scanMs;
    if (at[index] === scan || index + 1 === at.length || value[index] === value[index + 1]) return valueText(signal, known);
    const share = (scan - at[index]) / (at[index + 1] - at[index]);
    return '≈ ' + valueText(signal, known + share * (value[index + 1] - known));
  }

  /* Scans to the end of the one at this time in which a machine was not stopped. */
  function ranBy({ at, counted, ran }, ms) {
    const index = indexAt(at, ms);
    if (index < 0) return 0;
    return ran[index] + (counted[index] < STOPPED ? Math.floor((ms - at[index]) / scanMs + 1e-6) + 1 : 0);
  }

  /* The time of a machine in its state, as its controller has it: it stands still while the machine does. */
  function elapsedAt(machine, ms) {
    const of = stays[machine], { at, value } = times[machine];
    const enters = entered[machine][indexAt(entered[machine], ms)] || 0, set = indexAt(at, ms);
    const [since, known] = set >= 0 && at[set] >= enters ? [at[set], value[set]] : [enters, 0];
    return known + (ranBy(of, ms) - ranBy(of, since)) * scanMs;
  }

  /* The stay of a machine at a time: up to where it enters a state next, the same one too. */
  function stayAt(machine, ms) {
    const { at, state, counted } = stays[machine], enters = entered[machine];
    const index = Math.max(0, indexAt(at, ms)), entry = Math.max(0, indexAt(enters, ms));
    const isLast = entry + 1 >= enters.length;
    return {
      key: `${index} ${entry}`,
      state: state[index] || 0,
      counted: KINDS[counted[index]] || 'stopped',
      sinceMs: enters[entry] || 0,
      nextMs: isLast ? null : enters[entry + 1],
      nextState: isLast ? null : state[indexAt(at, enters[entry + 1])],
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
      const found = new Set();
      const all = machine === null ? stays.map((_, number) => number) : [machine];
      for (const number of all) {
        const { at, counted } = stays[number];
        at.forEach((ms, i) => counted[i] !== UNKNOWN && found.add(ms));
        for (const ms of again[number]) found.add(ms);
      }
      // A new segment is another carrier or another motion.
      if (machine === null) for (const path of raw.paths) for (let i = 1; i < path.length; i++) found.add(path[i][0]);
      events.set(machine, Float64Array.from(found).sort());
    }
    return events.get(machine);
  }

  return {
    raw, scanMs, endMs, decimals, COUNTED, KINDS, stays, again, machines, signals, results: raw.results,
    changes, indexAt, valueAt, valueText, textAt, knownUntil, timesUntil, elapsedAt, stayAt, stateName, eventTimes,
  };
})();

/* A time as the axis shows it: h:mm:ss once there are minutes, with the decimals that are asked for. */
function clock(ms, decimals = Data.decimals) {
  const unit = 10 ** decimals;
  const total = Math.round((ms / 1000) * unit) / unit;
  if (Data.endMs < 600000) return total.toFixed(decimals) + ' s';
  const whole = Math.floor(total), rest = (total - whole).toFixed(decimals).slice(1);
  const two = (n) => String(n).padStart(2, '0');
  const minutes = `${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return (Data.endMs < 3600000 ? minutes : `${Math.floor(whole / 3600)}:${minutes}`) + rest;
}

function seconds(s, decimals = Data.decimals) {
  return s === null || s === undefined ? '–' : s.toFixed(decimals);
}

/* The colours of the page as its style has them at present. */
const Colours = (() => {
  let known = {};
  function read() {
    const style = getComputedStyle(document.documentElement);
    known = {};
    for (const name of ['bg', 'panel', 'ink', 'muted', 'line', 'grid', 'accent', 'bad', 'moving', 'working',
      'waiting', 'waiting-edge', 'stopped', 'unknown', 'on-moving', 'on-working', 'on-waiting', 'on-stopped', 'on-unknown', 'solid', 'solid-edge', 'lane',
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
