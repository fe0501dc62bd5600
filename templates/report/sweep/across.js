'use strict';
/* The axis of the values: numbers to scale, everything else at equal distances. */

const Across = (() => {
  /* Pixels between two labels. */
  const APART = 6;
  /* Numbers that are named themselves; of more, round ones are. */
  const MOST_NAMED = 12;
  /* Of a turned label: its angle in degrees, the least distance to the next one, and its greatest width. */
  const TURN = 35, LINE = 15, MOST_WIDTH = 120;
  const SLOPE = (TURN * Math.PI) / 180;
  const LINE_HEIGHT = 14;
  /* A scale in ratio is for numbers of which the greatest is so many times the least. */
  const FACTOR = 50;

  /* How unequal the distances of sorted numbers are. */
  function unevenness(sorted) {
    const steps = sorted.slice(1).map((value, i) => value - sorted[i]);
    const mean = steps.reduce((sum, step) => sum + step, 0) / steps.length;
    return Math.sqrt(steps.reduce((sum, step) => sum + (step - mean) ** 2, 0) / steps.length) / mean;
  }

  function isInRatio(sorted) {
    const least = sorted[0], greatest = sorted[sorted.length - 1];
    return sorted.length > 2 && least > 0 && greatest > FACTOR * least
      && unevenness(sorted.map(Math.log10)) < unevenness(sorted);
  }

  function areClear(labels) {
    return labels.every((label, i) => i === 0
      || label.x - labels[i - 1].x >= (Labels.width(label.text) + Labels.width(labels[i - 1].text)) / 2 + APART);
  }

  const level = (labels) => ({ labels, isTurned: false, height: LINE_HEIGHT, left: 0 });

  /* Each text ends at its place; `left` is how far they reach over the beginning of the axis. */
  function turned(labels) {
    const widths = labels.map(({ text }) => Labels.width(text));
    return {
      labels, isTurned: true, height: Math.ceil(Math.max(...widths) * Math.sin(SLOPE)) + LINE_HEIGHT,
      left: Math.max(...labels.map(({ x }, i) => widths[i] * Math.cos(SLOPE) - x)),
    };
  }

  const canHold = (count, length) => count * (APART + 6) <= length;

  /* The first one, the last one, and those between them that have room. */
  function some(labels) {
    const last = labels[labels.length - 1];
    const kept = [labels[0]];
    for (const label of labels.slice(1, -1)) {
      if (areClear([kept[kept.length - 1], label, last])) kept.push(label);
    }
    return areClear([labels[0], last]) ? [...kept, last] : kept;
  }

  function ofNumbers({ values }, length) {
    const numbers = values.map(Number);
    const order = numbers.map((_, i) => i).sort((a, b) => numbers[a] - numbers[b]);
    const sorted = order.map((i) => numbers[i]);
    const ratio = isInRatio(sorted);
    const measure = ratio ? Math.log10 : (value) => value;
    const [from, to] = [measure(sorted[0]), measure(sorted[sorted.length - 1])];
    const edge = Math.max(6, Math.min(30, length / (2 * values.length)));
    const x = (value) => edge + ((measure(value) - from) / (to - from)) * (length - 2 * edge);
    const places = numbers.map(x);
    let gap = length;
    for (let i = 1; i < order.length; i++) gap = Math.min(gap, places[order[i]] - places[order[i - 1]]);

    const own = order.map((i) => ({ x: places[i], text: values[i] }));
    function named() {
      if (own.length > MOST_NAMED && !canHold(own.length, length)) return null;
      if (areClear(own)) return level(own);
      if (gap >= LINE && Labels.widest(values) <= MOST_WIDTH) return turned(own);
      return own.length <= MOST_NAMED ? level(some(own)) : null;
    }

    function round() {
      const [least, greatest] = [sorted[0], sorted[sorted.length - 1]];
      const lists = ratio ? [[1, 2, 5], [1]].map((factors) => Ticks.inRatio(least, greatest, factors))
        : [10, 8, 6, 5, 4, 3, 2].map((most) => Ticks.even(least, greatest, most));
      const labels = lists.map((list) => list.map(({ value, text }) => ({ x: x(value), text })));
      return level(labels.find((found) => found.length > 1 && areClear(found)) || some(own));
    }

    return { places, order, gap, isToScale: true, isInRatio: ratio, ...(named() || round()) };
  }

  function ofWords({ values }, length) {
    const gap = length / values.length;
    const places = values.map((_, i) => (i + 0.5) * gap);
    const named = () => {
      const own = values.map((text, i) => ({ x: places[i], text }));
      if (canHold(own.length, length) && areClear(own)) return level(own);
      const each = Math.ceil(LINE / gap);
      const kept = own.filter((_, i) => i % each === 0);
      const texts = Labels.shortened(kept.map(({ text }) => text), Math.min(MOST_WIDTH, length / 3));
      const short = kept.map(({ x }, i) => ({ x, text: texts[i] }));
      return areClear(short) ? level(short) : turned(short);
    };
    return { places, order: values.map((_, i) => i), gap, isToScale: false, isInRatio: false, ...named() };
  }

  /* The distance of the greatest number from the least one is a number. */
  function canBeMeasured({ values }) {
    const numbers = values.map(Number);
    const [least, greatest] = numbers.reduce(([low, high], number) => [Math.min(low, number), Math.max(high, number)], [Infinity, -Infinity]);
    return Number.isFinite(greatest - least);
  }

  /* For each value its place on an axis of this many pixels, their order, the least distance, and labels. */
  function of(name, length) {
    return name.are_numbers && canBeMeasured(name) ? ofNumbers(name, length) : ofWords(name, length);
  }

  return { of, TURN };
})();
