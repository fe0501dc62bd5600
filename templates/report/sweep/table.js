'use strict';
/* All rows as a table, with the columns of the text. */

const RowTable = (() => {
  const { names, columns, kept, rows } = Sweep;
  /* A longer reason is shown from its beginning, until it is clicked. */
  const LONG = 160;

  function link(row) {
    const page = kept[row.number];
    if (!page) return String(row.number);
    const made = element('a', '', `${row.number}: report`);
    made.setAttribute('href', page);
    return made;
  }

  /* Words may be long; numbers stand in one line. */
  const named = (row, k) => (names[k].are_numbers ? Sweep.valueOf(row, k) : element('div', 'named', Sweep.valueOf(row, k)));

  /* A value as it is sorted: a number if all of it is one. */
  const value = (text) => (text.trim() !== '' && Number.isFinite(Number(text)) ? Number(text) : text);

  /* A cell as it is sorted: by the number at its beginning, such as that of `4 of 10`. */
  function cell(text) {
    if (text === 'same') return 0;
    const number = parseFloat(text);
    return Number.isNaN(number) ? null : number;
  }

  function reason(row) {
    const all = element('div', 'reason', row.reason, ...row.remarks.map((remark) => element('div', 'muted', remark)));
    if ([row.reason, ...row.remarks].join(' ').length > LONG) {
      all.classList.add('long');
      all.setAttribute('role', 'button');
      all.setAttribute('aria-expanded', 'false');
      choosable(all, () => {
        const isOpen = all.classList.toggle('open');
        all.setAttribute('aria-expanded', String(isOpen));
      });
    }
    return all;
  }

  function draw() {
    return sortedTable([
      { name: 'row', isNumber: true, show: link, sort: (row) => row.number },
      ...names.map((name, k) => ({
        name: name.title, isNumber: name.are_numbers, show: (row) => named(row, k), sort: (row) => value(Sweep.valueOf(row, k)),
      })),
      ...columns.map(({ title, about }, i) => ({
        name: title, about, isNumber: true, show: (row) => row.cells[i], sort: (row) => cell(row.cells[i]),
      })),
      { name: 'reason', show: reason, sort: (row) => row.reason },
    ], rows, { empty: 'The sweep has no rows.' });
  }

  return { draw };
})();
