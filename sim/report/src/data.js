// The data block of the page: JSON whose arrays are base64 of little-endian numbers. See DATA.md.

function bytes(text) {
  const binary = atob(text);
  const out = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i += 1) out[i] = binary.charCodeAt(i);
  return out.buffer;
}

/** Doubles. */
export function doubles(text) {
  return new Float64Array(bytes(text));
}

/** Singles. */
export function singles(text) {
  return new Float32Array(bytes(text));
}

/** Smallest and largest of the finite values of two arrays, from one index to another. */
export function extremes(low, high, from = 0, to = low.length - 1) {
  let least = Infinity;
  let most = -Infinity;
  for (let i = from; i <= to; i += 1) {
    if (low[i] < least) least = low[i];
    if (high[i] > most) most = high[i];
  }
  return least <= most ? [least, most] : [NaN, NaN];
}

/** Singles with what is to be added to each: a rate that hardly changes keeps its last digits. */
function shifted(text, offset) {
  const values = singles(text);
  return offset ? Float64Array.from(values, (value) => value + offset) : values;
}

/** What a report shows of the values of a curve. */
function summedUp(curve) {
  const [least, most] = extremes(curve.low, curve.high);
  return { ...curve, least, most };
}

/** A column over the time, in buckets. */
function column(entry, { time, centres, end }) {
  const low = shifted(entry.min, entry.offset);
  // Without `max`, each bucket holds one value.
  const banded = entry.max !== undefined && entry.max !== null;
  const high = banded ? shifted(entry.max, entry.offset) : low;
  let last = low.length - 1;
  while (last > 0 && Number.isNaN(low[last])) last -= 1;
  const hasFinal = typeof entry.final === 'number';
  const final = hasFinal ? [entry.final, entry.final] : [low[last], high[last]];
  // The samples that are known: the first of each bucket, and the last of all.
  const first = !banded ? low : entry.first && shifted(entry.first, entry.offset);
  const goesOn = hasFinal && banded && end > time[time.length - 1];
  const known = first && (goesOn
    ? { x: Float64Array.of(...time, end), y: Float64Array.of(...first, entry.final) }
    : { x: time, y: first });
  return summedUp({ ...entry, x: banded ? centres : time, starts: time, low, high, banded, known, final });
}

/** A curve over another axis: a value at each place. */
function curve(entry, unit) {
  const x = doubles(entry.x);
  const y = singles(entry.y);
  const interval = entry.low && [singles(entry.low), singles(entry.high)];
  const measured = entry.measured && { x: doubles(entry.measured[0]), y: singles(entry.measured[1]) };
  return summedUp({ ...entry, unit, frame: '', x, starts: x, low: y, high: y, banded: false, known: { x, y }, interval, measured });
}

/** Each number of some arrays once, rising. */
function rising(arrays) {
  const all = Float64Array.from(new Set(arrays.flatMap((array) => [...array])));
  return all.sort();
}

/** Charts over the time, which share their axis with the replay. */
function overTime(raw) {
  const time = doubles(raw.time);
  // Centres of the buckets: the last one ends with the run.
  const centres = time.map((t, k) => (t + (k + 1 < time.length ? time[k + 1] : Math.max(raw.end, t))) / 2);
  const columns = raw.columns.map((entry) => column(entry, { time, centres, end: raw.end }));
  const stops = rising([time, time.length > 0 ? [raw.end] : []]);
  const axis = { name: 'Time', noun: 'time', unit: 's', log: false, from: time[0] ?? 0, to: raw.end, whole: 'run' };
  const charts = raw.charts.map((chart) => ({ ...chart, limits: chart.limits ?? [], curves: chart.columns.map((index) => columns[index]), stops }));
  return { axis, charts, stops, events: raw.events };
}

/** Charts over another axis. */
function over(entry, index, planes) {
  const axis = { ...entry, noun: entry.name.toLowerCase(), whole: 'range' };
  const own = planes.filter((plane) => plane.axis === index);
  const charts = own.map((plane) => ({ ...plane, limits: [], curves: plane.curves.map((raw) => curve(raw, plane.unit)) }));
  const stops = rising(charts.flatMap((chart) => chart.curves.flatMap(({ x, measured }) => (measured ? [x, measured.x] : [x]))));
  return { axis, charts: charts.map((chart) => ({ ...chart, stops })), stops, events: [] };
}

function replayWindow(entry) {
  return {
    label: entry.label,
    magnify: entry.magnify,
    time: doubles(entry.time),
    attitude: doubles(entry.attitude),
    omega: singles(entry.omega),
    momentum: singles(entry.momentum),
    coordinates: doubles(entry.coordinates),
    rates: singles(entry.rates),
  };
}

/** The report's data, decoded; nothing where the page has none or has another format. */
export function readReport(element) {
  if (element === null) return null;
  const raw = JSON.parse(element.textContent);
  if (raw.format !== 1) return null;
  const planes = raw.planes ?? [];
  const groups = [overTime(raw), ...(raw.axes ?? []).map((entry, index) => over(entry, index, planes))];
  const replay = raw.replay && { ...raw.replay, windows: raw.replay.windows.map(replayWindow) };
  return { ...raw, groups, replay };
}

/** Index of the last element of a rising array that is not above a value; 0 if all are above. */
export function indexAt(array, value) {
  let from = 0;
  let to = array.length - 1;
  while (from < to) {
    const middle = (from + to + 1) >> 1;
    if (array[middle] <= value) from = middle;
    else to = middle - 1;
  }
  return from;
}

/** Index of the element of a rising array that is nearest to a value. */
export function nearest(array, value) {
  const k = indexAt(array, value);
  return k + 1 < array.length && value - array[k] > array[k + 1] - value ? k + 1 : k;
}

/**
 * The value of a curve at the cursor: that of the nearest sample, twice; where only the bucket is known, its least and its
 * greatest.
 */
export function valuesAt(curve, at) {
  const { known } = curve;
  if (!known) {
    const k = indexAt(curve.starts, at);
    return [curve.low[k], curve.high[k]];
  }
  const k = nearest(known.x, at);
  return [known.y[k], known.y[k]];
}

/** A measured point is at the cursor up to this share of the axis. */
const BESIDE = 0.01;

/** What was measured at the cursor; `width` is the length of the axis. */
export function measuredAt({ measured }, at, width) {
  if (!measured) return NaN;
  const k = nearest(measured.x, at);
  return Math.abs(measured.x[k] - at) > BESIDE * width ? NaN : measured.y[k];
}
