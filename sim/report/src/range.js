// The vertical range of a chart, and the ticks of logarithmic axes.

import { extremes } from './data.js';
import { number, powerOfTen } from './format.js';

/** Above a linear range and below it, a share of it stays empty. */
const PADDING = 0.06;
/** A limit above this many times the largest value on show would leave no room for the curves. */
const LIMIT_SHOWN = 3;

/** Whole decades about positive values from `least` to `most`; within those of the whole chart. */
function wholeDecades(least, most, range) {
  if (!(most > 0)) return range ?? [1e-1, 1e1];
  const lowest = range ? Math.max(least, Math.min(range[0], most)) : least;
  const bottom = 10 ** Math.floor(Math.log10(lowest) + 1e-9);
  const top = 10 ** Math.ceil(Math.log10(most) - 1e-9);
  return [bottom, top > bottom ? top : 10 * bottom];
}

/** The vertical range that shows every visible curve; `shownOf` has the indices of a curve on show. */
export function verticalRange(chart, curves, shownOf, whole) {
  if (whole && chart.range) return chart.range;
  let [least, most, positive] = [Infinity, -Infinity, Infinity];
  for (const curve of curves) {
    const { low, high } = curve;
    const [from, to] = shownOf(curve);
    const [a, b] = extremes(low, high, from, to);
    if (a < least) least = a;
    if (b > most) most = b;
    if (chart.log !== true) continue;
    // The smallest positive value decides on the lowest decade.
    for (let k = from; k <= to; k += 1) {
      const value = low[k] > 0 ? low[k] : high[k];
      if (value > 0 && value < positive) positive = value;
    }
  }
  if (chart.log === true) return wholeDecades(positive, most, chart.range);
  if (!(least <= most)) return [0, 1];
  const largest = Math.max(Math.abs(least), Math.abs(most));
  for (const { values } of chart.limits) {
    for (const value of values.filter((limit) => Math.abs(limit) <= LIMIT_SHOWN * largest)) {
      least = Math.min(least, value);
      most = Math.max(most, value);
    }
  }
  const padding = most > least ? PADDING * (most - least) : Math.abs(least) || 1;
  return [least - padding, most + padding];
}

/** Ticks of a logarithmic axis: whole decades, eight at most; 1, 2 and 5 where there are few. */
export function decades(low, high) {
  const [from, to] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  if (to - from >= 2) {
    const stride = Math.ceil((to - from) / 7);
    const all = [];
    for (let exponent = to; exponent >= from; exponent -= stride) all.unshift(10 ** exponent);
    return all;
  }
  const all = [];
  for (let exponent = from - 1; exponent <= to; exponent += 1) all.push(...[1, 2, 5].map((factor) => factor * 10 ** exponent));
  return all.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

/** The same as text: powers of ten, or numbers where these say more. */
export function powers(values) {
  const exponents = values.map((value) => Math.log10(value));
  const whole = exponents.every((exponent) => Math.abs(exponent - Math.round(exponent)) < 1e-6);
  if (whole && exponents.some((exponent) => Math.abs(exponent) > 3.5)) return exponents.map((exponent) => powerOfTen(Math.round(exponent)));
  return values.map((value) => number(value, 1));
}
