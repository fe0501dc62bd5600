'use strict';
/* What stands for a row in a chart, as the outline of a drawing. */

const Marks = (() => {
  const at = (value) => value.toFixed(1);
  const polygon = (points) => `M${points.map(([x, y]) => `${at(x)} ${at(y)}`).join('L')}Z`;
  const circle = (x, y, r) => `M${at(x - r)} ${at(y)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;
  const square = (x, y, r) => polygon([[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r]]);
  const diamond = (x, y, r) => polygon([[x, y - 1.3 * r], [x + 1.3 * r, y], [x, y + 1.3 * r], [x - 1.3 * r, y]]);
  const triangle = (x, y, r) => polygon([[x, y - 1.3 * r], [x + 1.2 * r, y + r], [x - 1.2 * r, y + r]]);
  const shapes = [circle, square, diamond, triangle];
  const cross = (x, y, r) => `M${at(x - r)} ${at(y - r)}L${at(x + r)} ${at(y + r)}M${at(x + r)} ${at(y - r)}L${at(x - r)} ${at(y + r)}`;

  /* The end of a whisker: a cap, or an arrow if it goes on outside of the range. */
  function end(x, y, limit, cap) {
    const isOutside = Math.sign(limit.direction) * (limit.y - y) > 0;
    if (!isOutside) return { y, d: `M${at(x - cap)} ${at(y)}H${at(x + cap)}` };
    const back = limit.y + limit.direction * 5;
    return { y: limit.y, d: `M${at(x - 4)} ${at(back)}L${at(x)} ${at(limit.y)}L${at(x + 4)} ${at(back)}` };
  }

  /* From `top` to `bottom`, within `ceiling` and `floor`; all of them places on the paper, from above. */
  function whisker(x, top, bottom, [ceiling, floor], cap) {
    const upper = end(x, top, { y: ceiling, direction: 1 }, cap);
    const lower = end(x, bottom, { y: floor, direction: -1 }, cap);
    return `${upper.d}M${at(x)} ${at(upper.y)}V${at(lower.y)}${lower.d}`;
  }

  /* A line through places; null is a gap. */
  function line(places) {
    let d = '', isBegun = false;
    for (const place of places) {
      if (place) d += `${isBegun ? 'L' : 'M'}${at(place[0])} ${at(place[1])}`;
      isBegun = Boolean(place);
    }
    return d;
  }

  return { of: (number) => shapes[number % shapes.length], cross, whisker, line };
})();
