'use strict';
/* What every page is made of: elements, tables and charts. */

/* An element with a class and children; strings become text, never markup. */
function element(tag, classes, ...children) {
  const made = document.createElement(tag);
  if (classes) made.className = classes;
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

function byId(id) {
  return document.getElementById(id);
}

/* A row that is chosen by a click, or by Enter or Space while it has the focus. */
function choosable(line, choose) {
  line.tabIndex = 0;
  line.addEventListener('click', choose);
  line.addEventListener('keydown', (event) => {
    if (event.target !== line || ![' ', 'Enter'].includes(event.key)) return;
    event.preventDefault();
    choose();
  });
}

/* Rows that are shown at first. */
const MOST_ROWS = 100;

/* Numbers within texts are compared as numbers. */
const TEXTS = new Intl.Collator('en', { numeric: true });

/* Numbers before texts, and last what there is not. */
function rank(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return 2;
  return typeof value === 'number' ? 0 : 1;
}

/* A table that is sorted by a click on a column. `columns`: name, what it means, what a cell shows, by what it is sorted; numbers stand to the right. */
function sortedTable(columns, rows, { chosen, first = 0, empty }) {
  if (!rows.length) return element('p', 'muted', empty);
  let by = first, isDown = false, most = MOST_ROWS;
  const heads = columns.map(({ name, about, isNumber }, i) => {
    const button = element('button', 'plain', name);
    button.addEventListener('click', () => {
      [by, isDown] = [i, by === i ? !isDown : false];
      fill();
    });
    const head = element('th', isNumber ? 'number' : '', button);
    head.scope = 'col';
    if (about) head.title = about;
    return head;
  });
  const body = element('tbody', ''), more = element('button', 'more');
  more.addEventListener('click', () => {
    most = Infinity;
    fill();
  });
  const order = (p, q) => {
    const ranks = [rank(p), rank(q)];
    if (ranks.includes(2)) return ranks[0] - ranks[1];
    const difference = ranks[0] - ranks[1] || (ranks[0] ? TEXTS.compare(p, q) : p - q);
    return isDown ? -difference : difference;
  };
  function sorted() {
    const key = columns[by].sort || columns[by].show;
    return rows.map((row) => ({ row, key: key(row) })).sort((a, b) => order(a.key, b.key)).map(({ row }) => row);
  }
  function fill() {
    heads.forEach((head, i) => head.setAttribute('aria-sort', i !== by ? 'none' : isDown ? 'descending' : 'ascending'));
    // Not as arguments of a call: there may be more rows than a call can have.
    const lines = document.createDocumentFragment();
    for (const row of sorted().slice(0, most)) {
      const line = element('tr', chosen ? 'link' : '', ...columns.map((column) => {
        return element('td', column.isNumber ? 'number' : '', column.show(row));
      }));
      if (chosen) choosable(line, () => chosen(row));
      lines.append(line);
    }
    body.replaceChildren(lines);
    more.hidden = rows.length <= most;
    more.textContent = `show all ${rows.length} rows`;
  }
  fill();
  const box = element('div', 'scroll', element('table', 'data', element('thead', '', element('tr', '', ...heads)), body), more);
  // So that it is scrolled with the keyboard too.
  box.tabIndex = 0;
  return box;
}

const SVG = 'http://www.w3.org/2000/svg';

/* An element of a drawing. */
function svg(tag, attributes, text) {
  const made = document.createElementNS(SVG, tag);
  Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
  if (text !== undefined) made.textContent = text;
  return made;
}
