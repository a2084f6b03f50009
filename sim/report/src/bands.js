// Curves on the canvas of a chart. Where the least and the largest value of a bucket lie apart on the
// screen, the band between them is filled and both edges are drawn; where they do not, one dashed line. Values that were
// measured are crosses, limits dashed lines.

import { LIMIT_DASH } from './palette.js';

/** Above this distance of the edges, in CSS pixels, a band is drawn. */
const APART = 2.5;

/** Half the size of a cross, CSS pixels. */
const CROSS = 3.5;

/** Values that were measured, as crosses. */
function drawMarks(u, { colour, measured: { x: all, y: values } }) {
  const { ctx } = u;
  const ratio = window.devicePixelRatio || 1;
  const floor = u.scales.y.distr === 3 ? u.scales.y.min : -Infinity;
  const half = CROSS * ratio;
  const path = new Path2D();
  for (let k = 0; k < all.length; k += 1) {
    if (!(values[k] >= floor)) continue;
    const [x, y] = [u.valToPos(all[k], 'x', true), u.valToPos(values[k], 'y', true)];
    path.moveTo(x - half, y);
    path.lineTo(x + half, y);
    path.moveTo(x, y - half);
    path.lineTo(x, y + half);
  }
  ctx.strokeStyle = colour;
  ctx.lineWidth = 1.2 * ratio;
  ctx.setLineDash([]);
  ctx.stroke(path);
}

/** The interval of a fitted curve, as a band. */
function fillInterval(u, curve, from, to) {
  const { ctx } = u;
  const floor = u.scales.y.distr === 3 ? u.scales.y.min : -Infinity;
  const [low, high] = curve.interval;
  const path = new Path2D();
  const place = (k, values) => [u.valToPos(curve.x[k], 'x', true), u.valToPos(Math.max(values[k], floor), 'y', true)];
  for (let k = from; k < to; k += 1) {
    if (![low[k], high[k], low[k + 1], high[k + 1]].every(Number.isFinite)) continue;
    path.moveTo(...place(k, high));
    path.lineTo(...place(k + 1, high));
    path.lineTo(...place(k + 1, low));
    path.lineTo(...place(k, low));
    path.closePath();
  }
  ctx.fillStyle = curve.colour;
  ctx.globalAlpha = 0.3;
  ctx.fill(path);
  ctx.globalAlpha = 1;
}

/** A limit over the time in which it holds: dashed lines. */
export function drawLimit(u, { values, from, to }, colours) {
  const { ctx } = u;
  const ratio = window.devicePixelRatio || 1;
  ctx.strokeStyle = colours.ink;
  ctx.lineWidth = 1.3 * ratio;
  ctx.setLineDash(LIMIT_DASH.map((length) => length * ratio));
  for (const value of values) {
    const y = u.valToPos(value, 'y', true);
    ctx.beginPath();
    ctx.moveTo(u.valToPos(from, 'x', true), y);
    ctx.lineTo(u.valToPos(to, 'x', true), y);
    ctx.stroke();
  }
  ctx.setLineDash([]);
}

/** Draws one curve, from one index to another: it has x, low, high (arrays), colour and dash. */
export function drawCurve(u, curve, from, to) {
  if (curve.measured) drawMarks(u, curve);
  if (curve.interval) fillInterval(u, curve, from, to);
  const { ctx } = u;
  const ratio = window.devicePixelRatio || 1;
  const log = u.scales.y.distr === 3;
  const floor = log ? u.scales.y.min : -Infinity;
  const count = to - from + 1;
  const x = new Float64Array(count);
  const top = new Float64Array(count);
  const bottom = new Float64Array(count);
  for (let i = 0; i < count; i += 1) {
    const { low, high } = curve;
    const k = from + i;
    const shown = high[k] >= floor && high[k] - low[k] >= 0;
    x[i] = u.valToPos(curve.x[k], 'x', true);
    top[i] = shown ? u.valToPos(high[k], 'y', true) : NaN;
    bottom[i] = shown ? u.valToPos(Math.max(low[k], floor), 'y', true) : NaN;
  }
  const wide = (i) => bottom[i] - top[i] > APART * ratio;

  const fill = new Path2D();
  const edges = new Path2D();
  const line = new Path2D();
  let last = 'none';
  for (let i = 0; i < count; i += 1) {
    const j = i + 1;
    if (Number.isNaN(top[i]) || j === count || Number.isNaN(top[j])) {
      // A value with no neighbour is a vertical stroke, at least two pixels long.
      if (!Number.isNaN(top[i]) && last === 'none') {
        edges.moveTo(x[i], Math.min(top[i], bottom[i] - 2 * ratio));
        edges.lineTo(x[i], bottom[i]);
      }
      last = 'none';
    } else if (wide(i) || wide(j)) {
      fill.moveTo(x[i], top[i]);
      fill.lineTo(x[j], top[j]);
      fill.lineTo(x[j], bottom[j]);
      fill.lineTo(x[i], bottom[i]);
      fill.closePath();
      edges.moveTo(x[i], top[i]);
      edges.lineTo(x[j], top[j]);
      edges.moveTo(x[i], bottom[i]);
      edges.lineTo(x[j], bottom[j]);
      last = 'band';
    } else {
      if (last !== 'line') line.moveTo(x[i], (top[i] + bottom[i]) / 2);
      line.lineTo(x[j], (top[j] + bottom[j]) / 2);
      last = 'line';
    }
  }
  ctx.lineJoin = 'round';
  ctx.fillStyle = curve.colour;
  ctx.strokeStyle = curve.colour;
  ctx.globalAlpha = 0.32;
  ctx.fill(fill);
  ctx.globalAlpha = 1;
  ctx.setLineDash([]);
  ctx.lineWidth = 0.9 * ratio;
  ctx.stroke(edges);
  ctx.setLineDash(curve.dash.map((length) => length * ratio));
  ctx.lineWidth = 1.6 * ratio;
  ctx.stroke(line);
  ctx.setLineDash([]);
}

/** Draws the vertical marks of events, with their numbers above the plot. */
export function drawEvents(u, events, colours, font) {
  const { ctx, bbox } = u;
  const ratio = window.devicePixelRatio || 1;
  const { min, max } = u.scales.x;
  ctx.strokeStyle = colours.event;
  ctx.fillStyle = colours.soft;
  ctx.lineWidth = ratio;
  ctx.font = font;
  ctx.textAlign = 'center';
  ctx.textBaseline = 'bottom';
  let occupied = -Infinity;
  events.forEach(({ time }, index) => {
    if (time < min || time > max) return;
    const x = Math.round(u.valToPos(time, 'x', true)) + 0.5;
    ctx.setLineDash([3 * ratio, 3 * ratio]);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.setLineDash([]);
    const text = String(index + 1);
    const half = ctx.measureText(text).width / 2;
    // A number that would cover the one before it is left out.
    if (x - half < occupied + 3 * ratio) return;
    ctx.fillText(text, x, bbox.top - 2 * ratio);
    occupied = x + half;
  });
}
