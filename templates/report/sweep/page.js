'use strict';
/* The page of a sweep: its head, a chart for each value that is varied, and its table. */

(() => {
  const { figure, rows, varied } = Sweep;
  /* Rows that are named as the best. */
  const MOST_BEST = 4;

  /* The best figure, and the rows that have it; of rows of which all runs are in it. */
  function best() {
    const sign = figure.best === 'greatest' ? -1 : 1;
    const whole = rows.filter(Sweep.isWhole);
    if (!whole.length) return null;
    const first = whole.reduce((best, row) => (sign * row.figure < sign * best.figure ? row : best));
    const text = Sweep.shown(first.figure);
    const equal = whole.filter((row) => Sweep.shown(row.figure) === text).map((row) => row.number);
    const named = equal.slice(0, MOST_BEST).join(', ');
    const more = equal.length > MOST_BEST ? ` and ${equal.length - MOST_BEST} more` : '';
    const of = rows.some(Sweep.isPartial) ? ' of rows with all runs' : '';
    return [`${figure.best} ${figure.title.toLowerCase()}${of}`, `${text}, ${equal.length > 1 ? 'rows' : 'row'} ${named}${more}`];
  }

  function figures() {
    const done = rows.filter((row) => row.finished_runs === row.runs).length;
    const all = [['rows', String(rows.length)], [figure.done, `${done} of ${rows.length}`]];
    return [...all, best()].filter(Boolean);
  }

  byId('figures').append(...figures().map(([name, value]) =>
    element('div', 'figure', element('dt', '', name), element('dd', '', value))));
  byId('rows').append(RowTable.draw());
  const charts = varied.map(Chart.panel);
  byId('charts').append(...charts.map(({ made }) => made));
  byId('charts').classList.toggle('one', charts.length === 1);
  const draw = () => charts.forEach((chart) => chart.draw());
  draw();
  addEventListener('resize', draw);

  // Paper has no button that shows more.
  addEventListener('beforeprint', () => {
    const more = document.querySelector('#rows .more');
    if (more && !more.hidden) more.click();
  });
})();
