'use strict';
/* Figures of the whole run: what limits it, what each machine did with its time, and throughput. */

const Figures = (() => {
  const { raw, results } = Data;
  const percent = (part, whole) => `${((100 * part) / (whole || 1)).toFixed(1)} %`;

  function head() {
    const facts = results.of_sweep || [];
    const row = facts.length ? `, ${facts[0].join(' ')}` : '';
    document.title = `${raw.name}${row} – report`;
    byId('name').textContent = raw.name;
    byId('facts').append(...facts.map(([name, value]) =>
      element('div', '', element('dt', '', name), element('dd', '', value))));
    byId('facts').hidden = !facts.length;
    const verdict = byId('verdict');
    const { violation } = results;
    const found = violation ? `${violation.text}: at ${seconds(violation.at_s)} s; the run ends: ` : '';
    verdict.textContent = found + results.reason;
    verdict.className = 'verdict ' + (results.finished && !violation ? 'good' : 'wrong');
    byId('notes').append(...(results.notes || []).map((note) => element('p', '', `Note: ${note}`)));
    byId('notes').hidden = !(results.notes || []).length;
    const [first] = shares(), whole = wholePath();
    const wrong = (results.alarms || []).reduce((sum, { count }) => sum + count, 0) + (results.faults || []).length
      + (results.fault ? 1 : 0);
    const contacts = (results.collisions || []).length;
    const figures = [
      results.orders ? ['orders made', `${results.orders_done} of ${results.orders}`] : null,
      results.items_asked === undefined ? null : ['items collected', `${results.items_collected} of ${results.items_asked}`],
      results.seconds_per_order ? ['seconds per order', results.seconds_per_order.toFixed(2)] : null,
      ['simulated', clock(Data.endMs)],
      ['contacts', String(contacts)],
      wrong ? ['alarms and faults', String(wrong)] : null,
      shares().length > 1 ? ['limited by', `${first.name}, ${percent(first.s, whole)}`] : null,
    ];
    byId('figures').append(...figures.filter(Boolean).map(([name, value]) =>
      element('div', 'figure', element('dt', '', name), element('dd', '', value))));
  }

  /* ---- What limits the line ---- */

  const wholePath = () => raw.limit.machines.reduce((sum, { s }) => sum + s, raw.limit.stands_s);

  /* For so long that it is more than 0.0 %. */
  const hasStood = () => raw.limit.stands_s >= 0.0005 * wholePath();

  /* Of the machines, and of times in which the line stood still, the greatest first. */
  function shares() {
    const stands = { name: 'standstill of the line', s: raw.limit.stands_s, machine: null };
    const all = raw.limit.machines.map((of) => ({ ...of, name: Data.machines[of.machine].name }));
    return [...all, ...(hasStood() ? [stands] : [])].sort((a, b) => b.s - a.s);
  }

  function limit() {
    const { machines, from_s, to_s } = raw.limit;
    const box = byId('limit');
    if (!machines.length && !hasStood()) {
      box.append(element('p', 'muted', 'Nothing happened in this run.'));
      return;
    }
    const whole = wholePath(), stands = raw.limit.stands_s;
    const name = ({ machine }) => Data.machines[machine].name;
    const [first, second] = machines;
    const states = (of) => of.states.slice(0, 3).map(([state, s]) => `${Data.stateName(of.machine, state)} ${s.toFixed(1)} s`).join(', ');
    const until = raw.words_until_s === null ? '' : ` before ${clock(raw.words_until_s * 1000)}`;
    const goal = (raw.made.length ? 'the last order' : raw.collected.length ? 'the last item that was collected' : 'the last action of a machine') + until;
    if (hasStood()) {
      box.append(element('p', !first || stands > first.s ? 'lead' : '', 'In ', element('strong', '', percent(stands, whole)),
        ` of the path to ${goal} the line stands still (${stands.toFixed(1)} of ${whole.toFixed(1)} s): before a start, without run_permit, in a fault or without power. This is the time of no machine.`));
    }
    if (first) box.append(element('p', 'lead', element('strong', '', name(first)),
      ` limits this run: ${percent(first.s, whole)} of the path to ${goal} is its own time (${first.s.toFixed(1)} of ${whole.toFixed(1)} s), most of it in ${states(first)}.`));
    if (second) {
      box.append(element('p', '', 'Next: ', element('strong', '', name(second)),
        ` with ${percent(second.s, whole)} (${second.s.toFixed(1)} s), most of it in ${states(second)}.`));
    }
    box.append(element('div', 'bars', ...shares().slice(0, 8).map((of, _, all) => {
      const bar = element('div', 'bar');
      bar.style.width = `${(100 * of.s) / all[0].s}%`;
      const line = element('button', 'bar-row', element('span', 'bar-name', of.name), element('span', 'bar-room', bar),
        element('span', 'number', percent(of.s, whole)));
      if (of.machine === null) line.disabled = true;
      else line.addEventListener('click', () => Player.choose({ machine: of.machine }));
      return line;
    })));
    box.append(element('details', 'method', element('summary', '', 'How it was found'), element('p', '',
      `Backwards from ${goal} at ${clock(to_s * 1000)} to ${clock(from_s * 1000)}. If a machine left its state because an input of its own changed, or a timer of the state expired, this time is its own. If another machine, which acted in the same scan or in the one before, let it continue, its waiting time does not count, and the path continues with the other machine. While the line stands still, the time is that of no machine. So all shares add up to the whole time. A second less in a state on the path makes the run shorter by at most one second, because another path may be nearly as long. In the chart above, the path is the line under the bars.`)));
  }

  /* ---- Utilisation ---- */

  function use() {
    const whole = results.simulated_s || 1;
    const rows = Data.machines.map((machine) => ({ machine, ...machine.account }));
    const share = (key) => ({
      name: key, isNumber: true, show: (row) => percent(row[key + '_s'], whole), sort: (row) => row[key + '_s'],
    });
    const piece = (className, title, s) => {
      const part = element('span', className);
      part.style.width = `${(100 * s) / whole}%`;
      part.title = `${title} ${seconds(s)} s`;
      return part;
    };
    const states = ({ machine }) => machine.in_states.map(([state, s]) => [Data.stateName(machine.number, state), s]);
    // What is counted as moving has a command under way: of a machine without commands the bar has its states.
    const bar = (row) => {
      if (row.machine.has_commands) {
        return element('div', 'stack', ...Data.COUNTED.map((key) => piece(key, key, row[key + '_s'])));
      }
      const parts = states(row).map(([name, s], i, all) => {
        const part = piece('working', name, s);
        part.style.opacity = String(1 - (0.8 * i) / all.length);
        return part;
      });
      return element('div', 'stack', ...parts, piece('stopped', 'stopped', row.stopped_s));
    };
    const longest = (row) => states(row).slice(0, 3).map(([name, s]) => `${name} ${percent(s, whole)}`).join(', ');
    const awaited = (row) => Object.entries(row.waiting_for || {}).sort((a, b) => b[1] - a[1]).map(([name]) => name);
    byId('use').append(sortedTable([
      { name: 'machine', show: (row) => row.machine.name, sort: (row) => row.machine.number },
      { name: 'time', show: bar, sort: (row) => row.moving_s + row.working_s },
      ...Data.COUNTED.map(share).map((column) => (column.name !== 'moving' ? column : {
        ...column, show: (row) => (row.machine.has_commands ? column.show(row) : 'no commands'),
      })),
      { name: 'longest in', show: longest },
      { name: 'waited for', show: (row) => awaited(row).slice(0, 4).join(', ') + (awaited(row).length > 4 ? ', …' : '') },
    ], rows, { chosen: (row) => Player.choose({ machine: row.machine.number }), empty: 'There are no machines.' }));
  }

  /* ---- Throughput ---- */

  function throughput() {
    const width = 3, { what } = raw.throughput;
    const list = raw.made.length ? raw.made : raw.collected;
    const times = [];
    for (let i = 0; i < list.length; i += width) times.push(list[i] * Data.scanMs);
    const box = byId('throughput');
    if (!times.length) {
      box.append(element('p', 'muted', 'No order was made, and no item came into a sink.'));
      return;
    }
    const perHour = (times.length / Data.endMs) * 3600000;
    box.append(element('p', '', `${times.length} ${what}, ${perHour.toFixed(1)} per hour over the whole run.`));
    box.append(chart(times, what));
  }

  /* The next number over this one that is easy to read. */
  function nice(most) {
    const unit = 10 ** Math.floor(Math.log10(most));
    return [1, 1.5, 2, 3, 4, 5, 6, 8, 10].map((n) => n * unit).find((n) => n >= most) || most;
  }

  /* Bars: how many in each of some equal times, per hour. A line: how many so far. */
  function chart(times, what) {
    const [W, H, L, R, T, B] = [640, 250, 48, 48, 26, 30];
    const { steps, span_ms: span } = raw.throughput;
    const x = (ms) => L + (ms / Data.endMs) * (W - L - R);
    const rates = steps.map(([begin, end, count]) => (count * 3600000) / (end - begin || 1));
    const [mostRate, mostCount] = [nice(Math.max(...rates)), nice(times.length)];
    const y = (share) => H - B - share * (H - T - B);
    const made = svg('svg', { viewBox: `0 0 ${W} ${H}`, class: 'chart', role: 'img' });
    for (const share of [0, 0.5, 1]) {
      made.append(svg('line', { x1: L, x2: W - R, y1: y(share), y2: y(share), class: 'grid' }));
      made.append(svg('text', { x: L - 6, y: y(share) + 4, class: 'left' }, String(Math.round(mostRate * share * 100) / 100)));
      made.append(svg('text', { x: W - R + 6, y: y(share) + 4 }, String(Math.round(mostCount * share * 100) / 100)));
    }
    rates.forEach((rate, i) => {
      const [begin, end, count] = steps[i];
      const [from, to] = [x(begin), x(end)];
      const bar = svg('rect', { x: from + 0.5, width: Math.max(to - from - 1, 0.5), y: y(rate / mostRate), height: (rate / mostRate) * (H - T - B), class: 'rate' });
      bar.append(svg('title', {}, `${clock(begin, 0)} to ${clock(end, 0)}: ${count}`));
      made.append(bar);
    });
    let d = `M${x(0)} ${y(0)}`;
    times.forEach((ms, i) => {
      d += `H${x(ms).toFixed(1)}V${y((i + 1) / mostCount).toFixed(1)}`;
    });
    made.append(svg('path', { d: d + `H${x(Data.endMs)}`, class: 'sum' }));
    for (const share of [0, 0.25, 0.5, 0.75, 1]) {
      made.append(svg('text', { x: x(share * Data.endMs), y: H - 10, class: 'middle' }, clock(share * Data.endMs, 0)));
    }
    made.append(svg('text', { x: 4, y: 14, class: 'rate-name' }, `per hour, in steps of ${span >= 60000 ? span / 60000 + ' min' : span / 1000 + ' s'}`));
    made.append(svg('text', { x: W - 4, y: 14, class: 'left sum-name' }, `${what} so far`));
    return made;
  }

  /* ---- What the page does not have ---- */

  function foot() {
    const notes = [...raw.left_out];
    if (raw.words_until_s !== null) {
      notes.push(`Signals were recorded until ${clock(raw.words_until_s * 1000)}, because there were too many changes; the path that limits the run, commands that ended in an error, and ends of alarms are found only for the time until then.`);
    }
    byId('left-out').append(...notes.map((note) => element('p', '', note)));
    byId('left-out').hidden = !notes.length;
    byId('tool').textContent = `${raw.tool} · trace ${results.trace_hash} · scan ${Data.scanMs} ms`;
  }

  function draw() {
    head();
    limit();
    use();
    throughput();
    foot();
  }

  return { draw };
})();
