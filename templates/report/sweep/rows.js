'use strict';
/* The rows of a sweep, and how they are told. */

const Sweep = (() => {
  const raw = JSON.parse(byId('data').textContent);
  const { names, figure, columns, kept } = raw;
  const rows = raw.rows.map((row, i) => ({ ...row, number: i + 1 }));
  /* The numbers of the names of which rows have different values. */
  const varied = names.map((_, k) => k).filter((k) => names[k].values.length > 1);

  const valueOf = (row, k) => names[k].values[row.at[k]];
  const hasFigure = (row) => row.figure !== null;
  /* Its mean is not that of all runs. */
  const isPartial = (row) => hasFigure(row) && row.measured_runs < row.runs;
  const isWhole = (row) => hasFigure(row) && !isPartial(row);
  const shown = (value) => value.toFixed(2);

  /* The values of a row by these names. */
  const told = (row, some) => some.map((k) => `${names[k].title} ${valueOf(row, k)}`).join(', ');

  function whyNone(row) {
    return row.finished_runs ? 'no figure, because the warm-up leaves no order or the scenario asks for something else' : row.reason;
  }

  /* All of a row in a line. */
  function about(row) {
    const point = `row ${row.number}: ${told(row, names.map((_, k) => k))}`;
    if (!hasFigure(row)) return `${point}: ${whyNone(row)}`;
    const half = row.half_width ? ` ± ${shown(row.half_width)}` : '';
    const runs = row.runs > 1 ? `, ${row.measured_runs} of ${row.runs} runs` : '';
    return `${point}: ${shown(row.figure)}${half} ${figure.unit}${runs}`;
  }

  return { names, figure, columns, kept, rows, varied, valueOf, hasFigure, isPartial, isWhole, shown, told, about };
})();
