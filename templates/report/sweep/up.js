'use strict';
/* The axis of the figures. */

const Up = (() => {
  /* Of the range of the figures, left free above and below. */
  const ROOM = 0.07;
  /* A range is at least this part of its figures: less is what doubles cannot be exact in. */
  const LEAST = 1e-6;

  /* A whisker longer than its mean says little, and would press all means together: half of the mean is shown of it. */
  const isFar = ({ figure, half_width: half }) => half > Math.abs(figure);
  const reach = (row) => (isFar(row) ? Math.abs(row.figure) / 2 : row.half_width || 0);

  /* Null if no row has a figure. */
  function range(rows) {
    let [low, high] = [Infinity, -Infinity];
    for (const row of rows) {
      if (!Sweep.hasFigure(row)) continue;
      low = Math.min(low, row.figure - reach(row));
      high = Math.max(high, row.figure + reach(row));
    }
    if (low > high) return null;
    const span = high - low;
    const room = span > Math.abs(high) * LEAST ? span * ROOM : Math.abs(high) * 0.1 || 1;
    return { from: low >= 0 ? Math.max(0, low - room) : low - room, to: high + room };
  }

  /* Round numbers in a range, `most` steps at most. */
  const ticks = (range, most) => (range ? Ticks.even(range.from, range.to, most) : []);

  return { range, ticks, isFar };
})();
