// What check.mjs expects of the legends, decoded from the data block without the page's own decoder.

import { interval } from './src/format.js';

function view(text, size) {
  const bytes = Buffer.from(text, 'base64');
  const read = size === 8 ? (i) => bytes.readDoubleLE(i) : (i) => bytes.readFloatLE(i);
  return Array.from({ length: bytes.length / size }, (_, i) => read(i * size));
}

/** The data block with its arrays decoded. */
export function decode(raw) {
  const time = view(raw.time, 8);
  const columns = raw.columns.map((column) => {
    const whole = (text) => view(text, 4).map((value) => value + (column.offset ?? 0));
    const first = column.max === undefined ? whole(column.min) : column.first && whole(column.first);
    return { ...column, low: whole(column.min), high: whole(column.max ?? column.min), first };
  });
  const planes = (raw.planes ?? []).map((plane) => ({
    ...plane,
    axis: raw.axes[plane.axis],
    curves: plane.curves.map((curve) => ({ ...curve, x: view(curve.x, 8), y: view(curve.y, 4) })),
  }));
  return { ...raw, time, columns, planes, start: time[0] ?? 0 };
}

/**
 * The texts of a column near an instant: the first sample of its bucket, or where that is not known the ends of its range, and,
 * as the instant is rounded, of both beside it; at the end of the run the last sample.
 */
export function bucketValues(report, index, time) {
  const { low, high, first, final } = report.columns[index];
  let k = 0;
  while (k + 1 < report.time.length && report.time[k + 1] <= time) k += 1;
  return [k, k - 1, k + 1]
    .filter((i) => i >= 0 && i < low.length)
    .map((i) => interval(first ? [first[i], first[i]] : [low[i], high[i]]))
    .concat(typeof final === 'number' ? [interval([final, final])] : []);
}

/** The texts of a curve over another axis near a place: of the points on both sides of it. */
export function pointValues({ x, y }, place) {
  const before = x.filter((at) => at <= place).length;
  const near = [before - 2, before - 1, before, before + 1].filter((i) => i >= 0 && i < x.length);
  return near.map((i) => interval([y[i], y[i]]));
}
