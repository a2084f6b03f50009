// Numbers as text: significant digits, powers of ten with superscripts, and the labels of axes.

const SUPERSCRIPTS = { '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹' };

/** The exponent of ten, in superscripts. */
export function powerOfTen(exponent) {
  return '10' + [...String(exponent)].map((c) => SUPERSCRIPTS[c]).join('');
}

/** With the typographic minus sign. */
function signed(text) {
  return text.replace('-', '\u2212');
}

/** A value with so many significant digits; outside 1e-3 to 1e6 four at most, and a power of ten. */
export function number(value, digits = 5) {
  if (value === undefined || Number.isNaN(value)) return '\u2013';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '\u2212∞';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) {
    const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    return signed(value.toFixed(Math.min(decimals, 12)));
  }
  const [mantissa, exponent] = value.toExponential(Math.min(digits, 4) - 1).split('e');
  return `${signed(mantissa)}×${powerOfTen(Number(exponent))}`;
}

/** One value, or two with a word between where they differ. */
export function interval([low, high], between = ' \u2026 ') {
  return low === high || Number.isNaN(low) ? number(low) : `${number(low)}${between}${number(high)}`;
}

/** A number without zeros at the end, for lengths of time and scales. */
export function plain(value, digits = 4) {
  const text = number(value, digits);
  if (!text.includes('.')) return text;
  const [mantissa, rest] = text.split('×');
  const trimmed = mantissa.replace(/0+$/, '').replace(/\.$/, '');
  return rest === undefined ? trimmed : `${trimmed}×${rest}`;
}

const TIME_UNITS = [[1, 's'], [1e-3, 'ms'], [1e-6, 'µs'], [1e-9, 'ns']];

/** A length of time with a unit that suits it. */
export function duration(seconds) {
  const [unit, name] = TIME_UNITS.find(([unit]) => seconds >= 0.999999 * unit) ?? TIME_UNITS.at(-1);
  return `${plain(seconds / unit)}\u00a0${name}`;
}

/** A place on an axis, with the decimals that tell steps of `step` apart. */
export function instant(seconds, step) {
  const decimals = step > 0 ? Math.max(0, Math.min(12, Math.ceil(-Math.log10(step)) + 1)) : 3;
  const text = seconds.toFixed(decimals);
  return signed(Number(text) === 0 ? text.replace('-', '') : text);
}

/**
 * How the ticks of an axis from `low` to `high` are written: value = offset + factor * tick.
 * The factor is a power of ten, a multiple of three, where plain numbers would be long; the offset is
 * zero unless all values are nearly the same.
 */
export function axisScale(low, high) {
  const span = high - low;
  const largest = Math.max(Math.abs(low), Math.abs(high));
  let offset = 0;
  if (span > 0 && span < 1e-4 * largest) {
    const step = 10 ** Math.ceil(Math.log10(span));
    offset = Math.round((low + high) / 2 / step) * step;
  }
  const size = offset === 0 ? largest : Math.max(Math.abs(low - offset), Math.abs(high - offset));
  const exponent = size > 0 ? Math.floor(Math.log10(size) + 1e-9) : 0;
  const factor = exponent < -2 || exponent > 3 ? 3 * Math.floor(exponent / 3) : 0;
  return { offset, exponent: factor };
}

/** The ticks as text. */
export function ticks(values, { offset, exponent }) {
  const factor = 10 ** exponent;
  const scaled = values.map((value) => (value - offset) / factor);
  const step = scaled.length > 1 ? Math.abs(scaled[1] - scaled[0]) : 1;
  let decimals = 0;
  while (decimals < 9 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 * step * 10 ** decimals) decimals += 1;
  return scaled.map((value) => {
    const text = value.toFixed(decimals);
    return signed(Number(text) === 0 ? text.replace('-', '') : text);
  });
}

/** What the numbers of an axis are to be multiplied by and added to, with the unit. */
export function axisUnit(unit, { offset, exponent }) {
  const plus = offset === 0 ? '' : `${signed(String(Number(offset.toPrecision(12))))} + `;
  const times = exponent === 0 ? '' : ` × ${powerOfTen(exponent)}`;
  return plus + times === '' ? unit : `${unit} (${plus}ticks${times})`.trim();
}

/** The next value of 1, 2, 5 times a power of ten that is not smaller. */
export function niceAbove(value) {
  const decade = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const step = [1, 2, 5, 10].find((candidate) => candidate * decade >= value * (1 - 1e-9));
  return step * decade;
}
