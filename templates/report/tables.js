'use strict';
/* Orders, items, contacts and alarms, as tables that can be sorted. */

const Tables = (() => {
  /* Where an item was, one after another, and from when on. */
  function stations(item) {
    const all = [];
    for (const segment of item.segments) {
      const { text } = Motion.carrierOf(segment);
      if (!all.length || all[all.length - 1].text !== text) all.push({ text, ms: segment[0] });
    }
    return all;
  }

  function orders() {
    const rows = Data.results.order_times || [];
    const duration = (order) => (order.opened_s === null || order.made_s === null ? null : order.made_s - order.opened_s);
    return sortedTable([
      { name: 'order', isNumber: true, show: (o) => String(o.order), sort: (o) => o.order },
      { name: 'station', show: (o) => o.station },
      { name: 'opened', isNumber: true, show: (o) => (o.opened_s === null ? '–' : clock(o.opened_s * 1000)), sort: (o) => o.opened_s },
      { name: 'made', isNumber: true, show: (o) => (o.made_s === null ? '–' : clock(o.made_s * 1000)), sort: (o) => o.made_s },
      { name: 'seconds', isNumber: true, show: (o) => seconds(duration(o)), sort: duration },
    ], rows, {
      chosen: (o) => Player.seek((o.made_s === null ? o.opened_s || 0 : o.made_s) * 1000),
      empty: Data.results.items_asked === undefined ? 'The scenario has no orders and no goal.'
        : `The scenario has no orders: its goal is items in sinks. ${Data.results.items_collected} of ${Data.results.items_asked} were collected.`,
    });
  }

  /* When an item came and when it left, null if it did not: of the whole run, also if the drawing ends before. */
  function life({ number, segments, endMs }) {
    if (Data.raw.lives) {
      const [begin = null, end = null] = Data.raw.lives[number];
      return { begin, end };
    }
    if (!segments.length) return { begin: null, end: null };
    const isGone = ['sink', 'collector', 'part', 'order'].includes(Motion.carrierOf(segments[segments.length - 1]).what);
    return { begin: segments[0][0], end: isGone ? endMs : null };
  }

  function items() {
    const rows = Motion.items.map((item) => ({ item, stations: stations(item), ...life(item) })).filter(({ begin }) => begin !== null);
    const { drawnUntil } = Motion;
    const path = ({ stations: all, end }) => [...all.map(({ text }) => text),
      ...((end === null ? Data.endMs : end) > drawnUntil ? [`… (not known after ${clock(drawnUntil, 0)})`] : [])].join(' → ');
    const kind = ({ item }) => item.kinds.map(([, number]) => Data.raw.kinds[number].name).join(' → ');
    return sortedTable([
      { name: 'item', show: ({ item }) => item.name, sort: ({ item }) => item.name },
      { name: 'kind', show: kind },
      { name: 'came', isNumber: true, show: (r) => clock(r.begin), sort: (r) => r.begin },
      { name: 'left', isNumber: true, show: (r) => (r.end === null ? '–' : clock(r.end)), sort: (r) => r.end },
      { name: 'on the line, s', isNumber: true, show: (r) => (r.end === null ? '–' : seconds((r.end - r.begin) / 1000)), sort: (r) => (r.end === null ? null : r.end - r.begin) },
      { name: 'path', show: path },
    ], rows, {
      first: 2,
      chosen: ({ item, begin }) => {
        Player.choose({ item: item.number });
        if (!Motion.itemAt(item.number, Player.time())) Player.seek(begin);
      },
      empty: 'No item came onto the line.',
    });
  }

  function contacts() {
    return sortedTable([
      { name: 'time', isNumber: true, show: (c) => clock(c.time_s * 1000, 3), sort: (c) => c.time_s },
      { name: 'between', show: (c) => `${c.pair[0]} (${c.parts[0]}) and ${c.pair[1]} (${c.parts[1]})` },
      { name: 'at, m', show: (c) => c.place.map((v) => v.toFixed(3)).join(', ') },
      { name: 'times', isNumber: true, show: (c) => String(c.count), sort: (c) => c.count },
      { name: 'allowed', show: (c) => (c.allowed ? c.reason || 'yes' : 'no') },
    ], Data.results.collisions || [], {
      chosen: (c) => Player.seek(c.time_s * 1000),
      empty: 'The collision check found no contact.',
    });
  }

  function alarms() {
    const rows = Data.raw.alarms.map(([s, machine, text]) => ({ s, machine, text }));
    const name = ({ machine }) => (machine < 0 ? 'the line' : Data.machines[machine].name);
    return sortedTable([
      { name: 'time', isNumber: true, show: ({ s }) => clock(s * 1000), sort: ({ s }) => s },
      { name: 'machine', show: name },
      { name: 'what happened', show: ({ text }) => text },
    ], rows, {
      chosen: ({ s, machine }) => {
        if (machine >= 0) Player.choose({ machine });
        Player.seek(s * 1000);
      },
      empty: 'No fault, no command that ended in an error, no stop.',
    });
  }

  function draw() {
    byId('orders').append(orders());
    byId('items').append(items());
    byId('contacts').append(contacts());
    byId('alarms').append(alarms());
  }

  return { draw, stations };
})();
