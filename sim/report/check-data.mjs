// What check.mjs expects of the legends, decoded from the data block without the page's own decoder.

import { number } from './src/format.js';

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
    return { ...column, low: whole(column.min), high: whole(column.max ?? column.min) };
  });
  return { ...raw, time, columns, start: time[0] ?? 0 };
}

/** The texts of a column near an instant: of its bucket and, as the instant is rounded, of both beside it. */
export function bucketValues(report, index, time) {
  const { low, high } = report.columns[index];
  let k = 0;
  while (k + 1 < report.time.length && report.time[k + 1] <= time) k += 1;
  return [k, k - 1, k + 1]
    .filter((i) => i >= 0 && i < low.length)
    .map((i) => [number(low[i]), number(high[i])]);
}
