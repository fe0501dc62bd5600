'use strict';
/* The page of a sweep: its rows as a table, and what each thing that varies makes of them. */

(() => {
  const raw = JSON.parse(byId('data').textContent);
  const { names, rows } = raw;
  const { figure } = raw;
  const figureOf = (row) => row[figure.key];
  const done = rows.filter((row) => row.finished && figureOf(row) !== null);

  const nameOf = (row, name) => (name.kind === 'set' ? row.set[name.key] : row[name.key]);
  const textOf = (row, name) => {
    const value = nameOf(row, name);
    return typeof value === 'string' ? value : JSON.stringify(value);
  };
  const number = (value, decimals = 2) => (value === null || value === undefined ? '–' : value.toFixed(decimals));

  function link(row) {
    const page = raw.kept[row.row];
    if (!page) return String(row.row);
    const made = element('a', '', `${row.row}: report`);
    made.setAttribute('href', page);
    return made;
  }

  function table() {
    const more = [
      ['runs', 'runs', 0], ['half_width', '± 95 %', 2], ['cut_orders', 'cut', 1], ['difference', 'difference', 2],
      ['difference_half_width', '± 95 %', 2], ['measured_seconds_per_order', 'measured', 2], ['ratio', 'ratio', 3],
    ].filter(([key]) => rows.some((row) => row[key] !== undefined));
    return sortedTable([
      { name: 'row', isNumber: true, show: link, sort: (row) => row.row },
      ...names.map((name) => ({ name: name.title, show: (row) => textOf(row, name), sort: (row) => (typeof nameOf(row, name) === 'number' ? nameOf(row, name) : textOf(row, name)) })),
      ...(figure.key === 'goal_s' ? [
        { name: 'items', isNumber: true, show: (row) => (row.items_asked === null ? '–' : `${row.items} of ${row.items_asked}`), sort: (row) => row.items },
        { name: 'items per hour', isNumber: true, show: (row) => number(row.items_per_hour, 1), sort: (row) => row.items_per_hour },
      ] : [
        { name: 'orders', isNumber: true, show: (row) => (row.orders === null ? '–' : `${row.orders_done} of ${row.orders}`), sort: (row) => row.orders_done },
      ]),
      { name: figure.title.toLowerCase(), isNumber: true, show: (row) => number(figureOf(row)), sort: figureOf },
      ...more.map(([key, title, decimals]) => ({ name: title, isNumber: true, show: (row) => number(row[key], decimals), sort: (row) => row[key] })),
      { name: 'simulated, s', isNumber: true, show: (row) => number(row.simulated_s), sort: (row) => row.simulated_s },
      { name: 'reason', show: (row) => row.reason },
    ], rows, { empty: 'The sweep has no rows.' });
  }

  /* Each row as a point over the value that it has, and the mean of each value as a line. */
  function chart(name) {
    const [W, H, L, R, T, B] = [640, 270, 54, 16, 14, 46];
    const values = [...new Set(done.map((row) => textOf(row, name)))];
    const low = Math.min(...done.map((row) => figureOf(row) - (row.half_width || 0)));
    const high = Math.max(...done.map((row) => figureOf(row) + (row.half_width || 0)));
    const room = (high - low || high * 0.1 || 1) * 0.12;
    const [from, to] = [Math.max(0, low - room), high + room];
    const x = (i) => L + ((i + 0.5) / values.length) * (W - L - R);
    const y = (seconds) => H - B - ((seconds - from) / (to - from)) * (H - T - B);
    const made = svg('svg', { viewBox: `0 0 ${W} ${H}`, class: 'chart', role: 'img' });
    for (const share of [0, 0.25, 0.5, 0.75, 1]) {
      const seconds = from + share * (to - from);
      made.append(svg('line', { x1: L, x2: W - R, y1: y(seconds), y2: y(seconds), class: 'grid' }));
      made.append(svg('text', { x: L - 6, y: y(seconds) + 4, class: 'left' }, number(seconds, 1)));
    }
    const means = [];
    values.forEach((value, i) => {
      const own = done.filter((row) => textOf(row, name) === value);
      own.forEach((row) => {
        if (row.half_width) {
          const [top, bottom] = [figureOf(row) + row.half_width, figureOf(row) - row.half_width];
          made.append(svg('line', { x1: x(i), x2: x(i), y1: y(top), y2: y(bottom), class: 'whisker' }));
        }
        const dot = svg('circle', { cx: x(i), cy: y(figureOf(row)), r: 4, class: 'dot' });
        const about = names.map((other) => `${other.title} ${textOf(row, other)}`).join(', ');
        dot.append(svg('title', {}, `row ${row.row}: ${about}: ${number(figureOf(row))} s`));
        made.append(dot);
      });
      means.push([x(i), y(own.reduce((sum, row) => sum + figureOf(row), 0) / own.length)]);
      const step = Math.ceil(values.length / 12);
      if (i % step === 0) made.append(svg('text', { x: x(i), y: H - B + 18, class: 'middle' }, value.length > 18 ? value.slice(0, 17) + '…' : value));
    });
    made.append(svg('path', { d: 'M' + means.map((p) => p.join(' ')).join('L'), class: 'sum' }));
    made.append(svg('text', { x: (L + W - R) / 2, y: H - 8, class: 'middle' }, name.title));
    return made;
  }

  function draw() {
    document.title = 'Sweep – report';
    const sign = figure.best === "greatest" ? -1 : 1;
    const best = done.reduce((best, row) => (!best || sign * figureOf(row) < sign * figureOf(best) ? row : best), null);
    const figures = [['rows', String(rows.length)], [figure.done, String(rows.filter((row) => row.finished).length)]];
    if (best) figures.push([`${figure.best} ${figure.title.toLowerCase()}`, `${number(figureOf(best))}, row ${best.row}`]);
    byId('figures').append(...figures.map(([name, value]) =>
      element('div', 'figure', element('dt', '', name), element('dd', '', value))));
    byId('rows').append(table());
    const varied = names.filter((name) => new Set(done.map((row) => textOf(row, name))).size > 1);
    byId('charts').append(...varied.map((name) =>
      element('section', 'panel', element('h2', '', `${figure.title} by ${name.title}`), chart(name))));
    byId('tool').textContent = raw.tool;
  }

  draw();
})();
