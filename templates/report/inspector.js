'use strict';
/* What is known of the machine or the item that was clicked, at the present time. */

const Inspector = (() => {
  const box = byId('inspector');
  let made = null;

  const badge = (counted) => element('span', 'badge ' + counted, counted);

  function row(name, value) {
    const cell = element('td', 'value', value);
    return { line: element('tr', '', element('th', '', name), cell), cell };
  }

  /* The signals of a machine in one group, with a button that shows them on the time line. */
  function group(machine, title, name) {
    const signals = Data.signals.filter((signal) => signal.machine === machine && signal.group === name);
    if (!signals.length) return null;
    const own = Data.machines[machine].name.length + 1;
    const rows = signals.map((signal) => {
      const button = element('button', 'plain', signal.name.slice(own));
      button.title = 'show it on the time line';
      button.addEventListener('click', () => Signals.add(signal));
      return { signal, ...row(button, '') };
    });
    const table = element('table', 'ports', element('tbody', '', ...rows.map(({ line }) => line)));
    return { rows, element: element('details', '', element('summary', '', `${title} (${signals.length})`), table) };
  }

  function ofMachine(number) {
    const machine = Data.machines[number];
    const head = element('div', 'head', element('h3', '', machine.name), element('span', 'muted', machine.automaton.name));
    const doc = machine.automaton.doc ? element('p', 'muted', machine.automaton.doc) : null;
    const state = element('div', 'state');
    const groups = [['Inputs', 'input'], ['Outputs', 'output'], ['Cells', 'cell'], ['Variables', 'local']]
      .map(([title, name]) => group(number, title, name)).filter(Boolean);
    if (groups.length) groups[0].element.open = true;
    box.replaceChildren(head, ...(doc ? [doc] : []), state, ...groups.map((group) => group.element));
    return { machine: number, item: null, state, groups, key: null };
  }

  function transitions(machine, stay) {
    const state = machine.automaton.states[stay.state];
    if (!state) return [];
    const lines = state.transitions.map(({ when, to }) => {
      const target = to === null ? 'stays' : to;
      const isNext = stay.nextState !== null && to === Data.stateName(machine.number, stay.nextState);
      return element('li', isNext ? 'next' : '', element('code', '', when), element('span', 'target', '→ ' + target));
    });
    const within = state.within === null ? [] :
      [element('li', '', element('code', '', state.within === true ? 'a longest stay' : `after ${state.within} s`),
        element('span', 'target bad', '→ fault'))];
    return [...lines, ...within];
  }

  /* The place of a vehicle or of a tool, by its motion: as its controller has it in the present scan. */
  function measuredText({ number, measured }, signal, ms) {
    const axis = measured ? signal.number - measured.signal : -1;
    if (axis < 0 || axis > 2 || ms > Motion.drawnUntil) return null;
    const latched = (Math.floor(ms / Data.scanMs + 1e-6) - measured.late) * Data.scanMs;
    if (latched < 0) return null;
    const place = measured.what === 'tool' ? Motion.framesAt(number, latched).slice(-1)[0].slice(9) : Motion.positionAt(number, latched);
    return Data.valueText(signal, place[axis]);
  }

  function updateMachine(ms) {
    const machine = Data.machines[made.machine], stay = Data.stayAt(made.machine, ms);
    if (made.key !== stay.key) {
      made.key = stay.key;
      const state = machine.automaton.states[stay.state];
      const list = transitions(machine, stay);
      const time = element('span', 'time');
      const known = stay.nextMs === null ? 'until the end' :
        `then ${Data.stateName(made.machine, stay.nextState) || 'not shown'} at ${clock(stay.nextMs)}`;
      const next = state ? known : 'not shown from here on';
      made.state.replaceChildren(
        element('div', 'now', element('strong', '', state ? state.name : ''), badge(stay.counted), time),
        ...(state && state.doc ? [element('p', '', state.doc)] : []),
        element('p', 'muted', next + (state ? `, ${state.place}` : '')),
        ...(list.length ? [element('h4', '', 'It waits for'), element('ul', 'transitions', ...list)] : []));
      made.time = time;
    }
    const isKnown = stay.counted !== 'unknown' && ms <= Data.timesUntil;
    made.time.textContent = !isKnown ? '' : `${seconds(Data.elapsedAt(made.machine, ms) / 1000)} s`;
    for (const { element: details, rows } of made.groups) {
      if (details.open) rows.forEach(({ signal, cell }) => {
        const text = measuredText(machine, signal, ms) || Data.textAt(signal, ms);
        if (cell.textContent !== text) cell.textContent = text;
      });
    }
  }

  function ofItem(number) {
    const item = Motion.items[number];
    const kind = element('span', 'muted');
    const head = element('div', 'head', element('h3', '', item.name), kind);
    const place = element('p', '');
    const path = element('ol', 'path', ...Tables.stations(item).map(({ text, ms }) => {
      const jump = element('button', 'plain', clock(ms));
      jump.addEventListener('click', () => Player.seek(ms));
      return element('li', '', jump, ' ', text);
    }));
    box.replaceChildren(head, place, element('h4', '', 'Its path'), path);
    return { machine: null, item: number, kind, place };
  }

  function updateItem(ms) {
    const found = Motion.itemAt(made.item, ms);
    const text = found ? `${found.carrier.text}, at ${found.place.map((v) => v.toFixed(3)).join(', ')} m` : 'not on the line';
    if (made.place.textContent !== text) made.place.textContent = text;
    const kind = Motion.kindAt(Motion.items[made.item], ms).name;
    if (made.kind.textContent !== kind) made.kind.textContent = kind;
  }

  function nothing() {
    const keys = [['Space', 'play, pause'], ['N, P', 'next and previous event'], ['← →', 'one second back or forward'],
      ['+ −', 'zoom of the time line'], ['wheel', 'zoom of the plan'], ['Ctrl wheel', 'zoom of the time line'],
      ['Esc', 'clear the selection']];
    box.replaceChildren(
      element('div', 'head', element('h3', '', 'Nothing selected')),
      element('p', 'muted', 'Click a machine on the plan or its row below to see its state, its ports and the machines for which it waits. Click an item to see its path. Events are then only those of the selected machine.'),
      element('table', 'keys', element('tbody', '', ...keys.map(([key, text]) => row(element('kbd', '', key), text).line))));
    return { machine: null, item: null };
  }

  function draw(ms) {
    const { machine, item } = Player.chosen;
    if (!made || made.machine !== machine || made.item !== item) {
      made = machine !== null ? ofMachine(machine) : item !== null ? ofItem(item) : nothing();
    }
    if (machine !== null) updateMachine(ms);
    else if (item !== null) updateItem(ms);
  }

  return { draw };
})();
