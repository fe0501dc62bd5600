'use strict';
/* Round numbers on an axis. */

const Ticks = (() => {
  /* Of what doubles cannot be exact in. */
  const NOISE = 1e-9;

  /* With so many decimals; of numbers that would be long, as a power of ten. */
  function shown(value, decimals) {
    const isLong = decimals > 9 || Math.abs(value) >= 1e12;
    return isLong ? String(Number(value.toPrecision(6))) : value.toFixed(decimals);
  }

  /* At equal distances, `most` steps at most, each with as many decimals as the distance needs. */
  function even(from, to, most) {
    const unit = 10 ** Math.floor(Math.log10((to - from) / most));
    const step = [1, 2, 5, 10].map((n) => n * unit).find((s) => (to - from) / s <= most + NOISE) || 10 * unit;
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + NOISE));
    const first = Math.ceil(from / step - NOISE), last = Math.floor(to / step + NOISE);
    return Array.from({ length: last - first + 1 }, (_, i) => {
      const value = (first + i) * step;
      return { value, text: shown(value, decimals) };
    });
  }

  /* Powers of ten, and with `factors` such as 1, 2 and 5 their multiples. */
  function inRatio(from, to, factors) {
    const all = [];
    for (let power = Math.floor(Math.log10(from)); power <= Math.log10(to) + NOISE; power++) {
      for (const factor of factors) {
        const value = factor * 10 ** power;
        if (value >= from * (1 - NOISE) && value <= to * (1 + NOISE)) all.push({ value, text: shown(value, Math.max(0, -power)) });
      }
    }
    return all;
  }

  return { even, inRatio };
})();
