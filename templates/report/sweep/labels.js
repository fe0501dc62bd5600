'use strict';
/* Texts beside an axis: how wide they are, and how they become shorter. */

const Labels = (() => {
  const pen = document.createElement('canvas').getContext('2d');
  /* As in the style of charts. */
  pen.font = `11px ${getComputedStyle(document.body).fontFamily}`;
  const width = (text) => pen.measureText(text).width;
  const widest = (texts) => texts.reduce((most, text) => Math.max(most, width(text)), 0);

  /* Characters that two texts have in common at their beginning, or with `from` -1 at their end. */
  function alike(one, other, from) {
    const most = Math.min(one.length, other.length);
    let count = 0;
    const at = (text) => text.at(from < 0 ? -1 - count : count);
    while (count < most && at(one) === at(other)) count++;
    return count;
  }

  /* Where a text differs from all others: what stands before, and what after, may be cut. */
  function parts(text, texts) {
    const others = texts.filter((other) => other !== text);
    const most = (from) => others.reduce((length, other) => Math.max(length, alike(text, other, from)), 0);
    const head = most(1), tail = Math.min(most(-1), text.length - head);
    return [text.slice(0, head), text.slice(head, text.length - tail), text.slice(text.length - tail)];
  }

  /* With this many characters at most: without its middle. */
  function cut(text, most) {
    if (text.length <= most) return text;
    const begin = Math.ceil((most - 1) / 2);
    return most < 1 ? '' : `${text.slice(0, begin)}…${text.slice(text.length - (most - 1 - begin))}`;
  }

  /* The same, of a text that is not to lose what makes it differ. */
  function cutApart([head, own, tail], most) {
    const room = most - own.length;
    if (room < 3 || !(head || tail)) return cut(head + own + tail, most);
    const right = Math.min(tail.length, Math.floor(room / 2));
    const left = Math.min(head.length, room - right);
    return cut(head, left) + own + cut(tail, room - left);
  }

  /* No wider than this, and different where they were, if that can be. */
  function shortened(texts, room) {
    if (widest(texts) <= room) return texts;
    const all = texts.map((text) => parts(text, texts));
    const areApart = (some) => new Set(some).size === new Set(texts).size;
    const longest = texts.reduce((most, text) => Math.max(most, text.length), 0);
    let fitting = null;
    for (let most = Math.min(longest, 60); most > 3; most--) {
      const some = all.map((text) => cutApart(text, most));
      if (widest(some) > room) continue;
      if (areApart(some)) return some;
      fitting = fitting || some;
    }
    return fitting || texts.map((text) => cut(text, 4));
  }

  return { width, widest, shortened };
})();
