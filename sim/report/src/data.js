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

function column(entry) {
  const low = shifted(entry.min, entry.offset);
  // Without `max`, each bucket holds one value.
  const banded = entry.max !== undefined && entry.max !== null;
  const high = banded ? shifted(entry.max, entry.offset) : low;
  const [least, most] = extremes(low, high);
  let last = low.length - 1;
  while (last > 0 && Number.isNaN(low[last])) last -= 1;
  const final = typeof entry.final === 'number' ? [entry.final, entry.final] : [low[last], high[last]];
  return { ...entry, low, high, banded, least, most, final };
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
  const time = doubles(raw.time);
  const columns = raw.columns.map(column);
  // Centres of the buckets: the last one ends with the run.
  const centres = time.map((t, k) => (t + (k + 1 < time.length ? time[k + 1] : Math.max(raw.end, t))) / 2);
  const replay = raw.replay && { ...raw.replay, windows: raw.replay.windows.map(replayWindow) };
  return { ...raw, time, centres, columns, replay };
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
