'use strict';
/* The figures of the rows by one of the values that are varied. */

const Chart = (() => {
  const LEAST_WIDTH = 50, PLOT = 220, TOP = 12, RIGHT = 16, TITLE = 20;
  const MOST_TICKS = 7;
  /* With more rows, marks are drawn together and have no texts of their own. */
  const MOST_TOLD = 3000;
  /* Pixels between marks of the same value at most, and all of them; for numbers these are a shift from their place. */
  const BESIDE = 14, NUMBERS_BESIDE = 7, ALL_NUMBERS_BESIDE = 36;

  /* Draws an axis of figures and one of values into a box of this width. */
  function drawn(k, all, width) {
    const name = Sweep.names[k];
    const range = Up.range(Sweep.rows);
    const ticks = Up.ticks(range, MOST_TICKS);
    const ofTicks = Labels.widest(ticks.map(({ text }) => text)) + 12;
    let left = ofTicks, across = Across.of(name, width - left - RIGHT);
    if (across.left > left) {
      left = Math.min(across.left + 4, width / 2);
      across = Across.of(name, width - left - RIGHT);
    }
    const bottom = TOP + PLOT, height = bottom + 8 + across.height + TITLE;
    const y = (figure) => bottom - ((figure - range.from) / (range.to - range.from)) * PLOT;
    const made = svg('svg', { viewBox: `0 0 ${width} ${height}`, width, height, class: 'chart', role: 'img', 'aria-label': label(k, all) });
    for (const { value, text } of ticks) {
      made.append(svg('line', { x1: left, x2: width - RIGHT, y1: y(value), y2: y(value), class: 'grid' }));
      made.append(svg('text', { x: left - 6, y: y(value) + 4, class: 'left tick' }, text));
    }
    made.append(svg('line', { x1: left, x2: width - RIGHT, y1: bottom, y2: bottom, class: 'axis' }));
    for (const { x, text } of across.labels) {
      made.append(svg('line', { x1: left + x, x2: left + x, y1: bottom, y2: bottom + 4, class: 'axis' }));
      const place = { x: left + x, y: bottom + 16, class: `value ${across.isTurned ? 'left' : 'middle'}` };
      if (across.isTurned) place.transform = `rotate(${-Across.TURN} ${left + x + 3} ${bottom + 12})`;
      made.append(svg('text', place, text));
    }
    const note = across.isInRatio ? ' (logarithmic scale)' : '';
    made.append(svg('text', { x: (left + width - RIGHT) / 2, y: height - 6, class: 'middle axis-name' }, name.title + note));
    const most = across.isToScale ? Math.min(NUMBERS_BESIDE, ALL_NUMBERS_BESIDE / all.length) : BESIDE;
    const beside = Math.min(most, (0.7 * across.gap) / all.length);
    const radius = across.gap > 10 ? 4 : across.gap > 5 ? 3 : 2;
    const paper = { left, bottom, y, beside, radius, across, count: all.length, area: [TOP, bottom] };
    // Colours lie over grey.
    for (const series of [...all].reverse()) made.append(...of(series, paper));
    return made;
  }

  function label(k, all) {
    const { values, title } = Sweep.names[k];
    const lines = all.length > 1 ? `, ${all.length} combinations of the other values` : '';
    return `${Sweep.figure.title} by ${title}: ${values.length} values${lines}. The table of rows has the same figures.`;
  }

  /* The drawing of one series: its line, then its rows. */
  function of(series, { left, bottom, y, beside, radius, across, count, area }) {
    const shift = (series.number - (count - 1) / 2) * beside;
    const inOrder = across.order.map((i) => series.rows.get(i));
    const x = (row, i) => left + across.places[across.order[i]] + shift;
    const group = svg('g', { class: series.style });
    if (across.isToScale) {
      const places = inOrder.map((row, i) => (row && Sweep.hasFigure(row) ? [x(row, i), y(row.figure)] : null));
      group.append(svg('path', { d: Marks.line(places), class: 'line' }));
    }
    const cap = Math.max(1, Math.min(4, beside / 2 || 4));
    const kinds = { whisker: '', mark: '', 'mark hollow': '', cross: '' };
    const isTold = Sweep.rows.length <= MOST_TOLD;
    inOrder.forEach((row, i) => {
      if (!row) return;
      const own = isTold ? {} : kinds;
      const add = (kind, d) => { own[kind] = (own[kind] || '') + d; };
      if (!Sweep.hasFigure(row)) {
        add('cross', Marks.cross(x(row, i), bottom, radius));
      } else {
        const { figure, half_width: half } = row;
        if (half) add('whisker', Marks.whisker(x(row, i), y(figure + half), y(figure - half), area, cap));
        add(Sweep.isPartial(row) ? 'mark hollow' : 'mark', Marks.of(series.number)(x(row, i), y(figure), radius));
      }
      if (!isTold) return;
      const one = svg('g', { class: 'row' });
      append(one, own);
      one.append(svg('title', {}, Sweep.about(row)));
      group.append(one);
    });
    if (!isTold) append(group, kinds);
    return [group];
  }

  function append(group, outlines) {
    Object.entries(outlines).filter(([, d]) => d).forEach(([kind, d]) => group.append(svg('path', { d, class: kind })));
  }

  /* What the marks mean, of those that there are. */
  function notes() {
    const { rows } = Sweep;
    const count = (is) => rows.reduce((sum, row) => sum + (is(row) ? 1 : 0), 0);
    const counted = (number) => `${number} of ${rows.length} rows`;
    const [none, partial] = [count((row) => !Sweep.hasFigure(row)), count(Sweep.isPartial)];
    const unfinished = count((row) => Sweep.hasFigure(row) && row.finished_runs < row.runs);
    const cut = count((row) => Sweep.hasFigure(row) && row.measured_runs < row.finished_runs);
    return [
      rows.some((row) => row.half_width) && 'Bars: 95 % intervals of the means.',
      rows.some(Up.isFar) && 'An arrow: the interval goes on outside of the chart.',
      none && `Crosses: ${counted(none)} without a figure.`,
      partial && `Hollow: ${counted(partial)} with some of their runs only.`,
      unfinished && unfinishedNote(unfinished),
      cut && 'The warm-up leaves nothing of some runs: the others are the slower ones, so a mean is mostly too great.',
      rows.length > MOST_TOLD && 'There are too many rows for texts at the marks; the table has all.',
    ].filter(Boolean).join(' ');
  }

  function unfinishedNote(count) {
    const whose = count === 1 ? 'Its mean is' : 'Their means are';
    const result = Sweep.figure.unit === 's' ? `, so ${count === 1 ? 'it is' : 'they are'} mostly too small` : '';
    return `${whose} of the runs that finished${result}.`;
  }

  /* A panel, and what draws its chart as wide as it is now. */
  function panel(k) {
    const all = Series.by(k);
    const box = element('div', 'chart-box');
    const made = element('section', 'panel', element('h2', '', `${Sweep.figure.title} by ${Sweep.names[k].title}`), Series.legend(all), box,
      element('p', 'muted notes-of-chart', notes()));
    let last = 0;
    const draw = () => {
      const width = box.clientWidth;
      if (width < LEAST_WIDTH || width === last) return;
      last = width;
      box.replaceChildren(drawn(k, all, width));
    };
    return { made, draw };
  }

  return { panel };
})();
