'use strict';
/* Rows that differ in one value alone: they have a line in its chart. */

const Series = (() => {
  /* That have a colour. */
  const MOST_COLOURS = 8;

  /* Those of a name, in the order of the table: the other values that are varied, as a text, and for each value of the name its row. */
  function by(k) {
    const others = Sweep.varied.filter((other) => other !== k);
    const found = new Map();
    for (const row of Sweep.rows) {
      const key = others.map((other) => row.at[other]).join();
      if (!found.has(key)) found.set(key, { title: Sweep.told(row, others), rows: new Map() });
      found.get(key).rows.set(row.at[k], row);
    }
    return [...found.values()].map((series, number) => ({
      ...series, number, style: number < MOST_COLOURS ? `series-${number}` : 'others',
    }));
  }

  /* What the colours stand for; nothing for one series. */
  function legend(all) {
    if (all.length < 2) return null;
    const list = element('ul', 'legend');
    for (const { title, number, style } of all.slice(0, MOST_COLOURS)) {
      const sign = svg('svg', { viewBox: '0 0 14 14', width: 14, height: 14, class: `sign ${style}`, 'aria-hidden': 'true' });
      sign.append(svg('path', { d: Marks.of(number)(7, 7, 4), class: 'mark' }));
      list.append(element('li', '', sign, title));
    }
    const rest = all.length - MOST_COLOURS;
    if (rest > 0) list.append(element('li', '', `grey: ${rest} more ${rest === 1 ? 'combination' : 'combinations'}`));
    return list;
  }

  return { by, legend };
})();
