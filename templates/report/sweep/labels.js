'use strict';
/* Texts beside an axis: how wide they are, and how they become shorter. */

const Labels = (() => {
  const pen = document.createElement('canvas').getContext('2d');
  /* As in the style of charts. */
  pen.font = `11px ${getComputedStyle(document.body).fontFamily}`;
  const width = (text) => pen.measureText(text).width;
  const widest = (texts) => texts.reduce((most, text) => Math.max(most, width(text)), 0);

  /* Characters at the beginning that all texts have. */
  function alike(texts) {
    let count = 0;
    while (texts[0].length > count && texts.every((text) => text[count] === texts[0][count])) count++;
    return count;
  }

  /* With this many characters at most: without some of the first `head` or the last `tail`, if they are enough. */
  function cut(text, most, head, tail) {
    const out = text.length - most + 1;
    if (out <= 1) return text;
    const middle = (from, to) => Math.max(from, Math.floor((from + to - out) / 2));
    const from = head > out ? middle(1, head) : tail > out ? middle(text.length - tail, text.length - 1) : middle(0, text.length);
    return `${text.slice(0, from)}…${text.slice(from + out)}`;
  }

  /* No wider than this, and different where they were, if that can be. */
  function shortened(texts, room) {
    if (widest(texts) <= room) return texts;
    const head = texts.length > 1 ? alike(texts) : 0;
    const tail = texts.length > 1 ? alike(texts.map((text) => [...text].reverse().join(''))) : 0;
    const areApart = (some) => new Set(some).size === new Set(texts).size;
    const longest = texts.reduce((most, text) => Math.max(most, text.length), 0);
    let fitting = null;
    for (let most = Math.min(longest, 60); most > 3; most--) {
      const some = texts.map((text) => cut(text, most, head, tail));
      if (widest(some) > room) continue;
      if (areApart(some)) return some;
      fitting = fitting || some;
    }
    return fitting || texts.map((text) => cut(text, 4, head, tail));
  }

  return { width, widest, shortened };
})();
