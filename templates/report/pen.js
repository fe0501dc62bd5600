'use strict';
/* The canvas of the floor plan: which part of the world it shows, and what is drawn on it in metres. */

const Pen = (() => {
  const canvas = byId('plan');
  /* Pixels for a metre, and what of the world is in the middle. */
  const view = { scale: 1, x: 0, y: 0, isFitted: true };
  const size = [0, 0];
  let context = canvas.getContext('2d');

  const toScreen = ([x, y]) => [size[0] / 2 + (x - view.x) * view.scale, size[1] / 2 - (y - view.y) * view.scale];
  const toWorld = ([px, py]) => [view.x + (px - size[0] / 2) / view.scale, view.y - (py - size[1] / 2) / view.scale];

  /* Clears the canvas; false while it has no size. */
  function begin() {
    if (!size[0]) return false;
    context = fitted(canvas, ...size);
    context.clearRect(0, 0, ...size);
    return true;
  }

  function trace(points, isClosed = true) {
    context.beginPath();
    points.forEach((p, i) => context[i ? 'lineTo' : 'moveTo'](...toScreen(p)));
    if (isClosed) context.closePath();
  }

  function paint({ corners, ends, radius }, fill, edge) {
    if (corners) {
      if (corners.length < 3) return;
      trace(corners);
      context.fillStyle = fill;
      context.fill();
      context.strokeStyle = edge;
      context.lineWidth = 1;
      context.stroke();
      return;
    }
    const width = 2 * radius * view.scale;
    trace(ends, false);
    context.lineCap = 'round';
    // A line without length has no caps in some browsers.
    if (Math.hypot(ends[0][0] - ends[1][0], ends[0][1] - ends[1][1]) * view.scale < 0.5) {
      const [x, y] = toScreen(ends[0]);
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + 0.5, y);
    }
    context.lineWidth = Math.max(width, 1.5);
    context.strokeStyle = edge;
    context.stroke();
    if (width > 3) {
      context.lineWidth = width - 2;
      context.strokeStyle = fill;
      context.stroke();
    }
  }

  function label(text, [x, y], pixels, dot = null) {
    const colours = Colours.get();
    context.font = `${dot ? 600 : 400} ${pixels}px ${colours.font}`;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.lineWidth = 3;
    context.lineJoin = 'round';
    context.strokeStyle = colours.bg;
    context.strokeText(text, x, y);
    context.fillStyle = colours.ink;
    context.fillText(text, x, y);
    if (dot) {
      const half = context.measureText(text).width / 2;
      context.beginPath();
      context.arc(x - half - 0.65 * pixels, y, pixels / 3, 0, 2 * Math.PI);
      context.fillStyle = dot;
      context.fill();
    }
  }

  return { canvas, view, size, toScreen, toWorld, begin, trace, paint, label, context: () => context };
})();
