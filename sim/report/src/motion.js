// The recorded motion of one window between its frames: attitude, vectors, joint coordinates.
//
// Quaternions are scalar first. That of B relative to N, read as a rotation, takes components in B to
// components in N, which is what a drawing needs.

import { indexAt } from './data.js';

/** Hamilton's product. */
function product(a, b) {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

function inverse(q) {
  return [q[0], -q[1], -q[2], -q[3]];
}

/** The quaternion of a rotation vector. */
function fromVector(v) {
  const angle = Math.hypot(v[0], v[1], v[2]);
  // sin(x / 2) / x, by its limit where x vanishes.
  const share = angle > 1e-8 ? Math.sin(angle / 2) / angle : 0.5;
  return [Math.cos(angle / 2), share * v[0], share * v[1], share * v[2]];
}

/** The rotation vector of a quaternion, not longer than half a turn. */
function toVector(q) {
  const sign = q[0] < 0 ? -1 : 1;
  const sine = Math.hypot(q[1], q[2], q[3]);
  const share = sine > 1e-12 ? (2 * Math.atan2(sine, sign * q[0])) / sine : 2;
  return [sign * share * q[1], sign * share * q[2], sign * share * q[3]];
}

/** Degree of the smooth motion's polynomials: rate, acceleration and its change belong to it. */
const DEGREE = 3;

/**
 * The polynomials in time that fit several sets of points best, by least squares. The weight of a point
 * falls to zero at both ends as the square of a sine, so that a vibration, cut off anywhere, hardly
 * bends them. Legendre's manner: powers made orthogonal, one after the other, on the points.
 */
function smooth(time, sets) {
  const n = time.length;
  const weights = time.map((t, k) => Math.sin((Math.PI * (k + 0.5)) / n) ** 2);
  const dot = (a, b) => a.reduce((sum, x, k) => sum + weights[k] * x * b[k], 0);
  const half = (time[n - 1] - time[0]) / 2;
  const scaled = (t) => (t - time[0]) / half - 1;
  // Each polynomial by its coefficients, lowest power first.
  const value = (p, t) => p.reduceRight((sum, c) => sum * scaled(t) + c, 0);
  const basis = [];
  for (let degree = 0; degree <= Math.min(DEGREE, n - 1); degree += 1) {
    const p = Array.from({ length: degree + 1 }, (_, i) => (i === degree ? 1 : 0));
    for (const { p: lower, at, square } of basis) {
      const share = dot(time.map((t) => value(p, t)), at) / square;
      lower.forEach((c, i) => {
        p[i] -= share * c;
      });
    }
    const at = time.map((t) => value(p, t));
    basis.push({ p, at, square: dot(at, at) });
  }
  const shares = sets.map((values) => basis.map(({ at, square }) => dot(values, at) / square));
  return (t) => shares.map((share) => share.reduce((sum, s, i) => sum + s * value(basis[i].p, t), 0));
}

/**
 * Attitude as smooth motion and deviation from it. The smooth motion turns from the middle frame's
 * attitude by a rotation vector cubic in time, fitted to the frames; the deviation of a frame is the
 * rotation vector from the smooth motion to the frame.
 */
function split(time, attitude) {
  const frames = [...time.keys()];
  const frame = (k) => [...attitude.subarray(4 * k, 4 * k + 4)];
  const middle = frame(time.length >> 1);
  const turned = frames.map((k) => toVector(product(inverse(middle), frame(k))));
  const fit = smooth([...time], [0, 1, 2].map((axis) => turned.map((v) => v[axis])));
  const course = (t) => fromVector(fit(t));
  const deviations = frames.map((k) => toVector(product(inverse(course(time[k])), fromVector(turned[k]))));
  const largest = Math.max(...deviations.map((d) => Math.hypot(...d)));
  return { base: (t) => product(middle, course(t)), deviations, largest };
}

/** Spherical interpolation along the shorter way. */
function slerp(a, b, share) {
  const turn = toVector(product(inverse(a), b));
  return product(a, fromVector(turn.map((v) => v * share)));
}

/** A window's motion; `joints` is the number of its joints. */
export function createMotion(window, joints) {
  const { time, attitude, omega, momentum, coordinates, rates, magnify } = window;
  const parts = magnify === 1 ? null : split(time, attitude);
  const end = time.length - 1;

  const mix = (array, k, next, share) =>
    [0, 1, 2].map((i) => (1 - share) * array[3 * k + i] + share * array[3 * next + i]);

  const largestOf = (array) => {
    let most = 0;
    for (let k = 0; k <= end; k += 1) {
      most = Math.max(most, Math.hypot(array[3 * k], array[3 * k + 1], array[3 * k + 2]));
    }
    return most;
  };

  return {
    start: time[0],
    end: time[end],
    magnify,
    /** The largest angle between a frame and the smooth motion, rad; 0 where nothing is magnified. */
    deviation: parts === null ? 0 : parts.largest,
    largestOmega: largestOf(omega),
    largestMomentum: largestOf(momentum),
    /** The state at an instant, which is moved into the window where it is outside. */
    at(instant) {
      const t = Math.min(Math.max(instant, time[0]), time[end]);
      const k = Math.min(indexAt(time, t), Math.max(end - 1, 0));
      const next = Math.min(k + 1, end);
      const step = time[next] - time[k];
      const s = step > 0 ? (t - time[k]) / step : 0;
      const quaternion = (i) => [...attitude.subarray(4 * i, 4 * i + 4)];
      const real = slerp(quaternion(k), quaternion(next), s);
      let shown = real;
      if (parts !== null) {
        const [a, b] = [parts.deviations[k], parts.deviations[next]];
        const deviation = a.map((value, i) => magnify * ((1 - s) * value + s * b[i]));
        shown = product(parts.base(t), fromVector(deviation));
      }
      // Cubic Hermite of coordinate and rate.
      const [h00, h10] = [(1 + 2 * s) * (1 - s) ** 2, s * (1 - s) ** 2];
      const [h01, h11] = [s * s * (3 - 2 * s), s * s * (s - 1)];
      const [from, to] = [k * joints, next * joints];
      const joint = [];
      const rate = [];
      for (let i = 0; i < joints; i += 1) {
        joint.push(h00 * coordinates[from + i] + h01 * coordinates[to + i]
          + step * (h10 * rates[from + i] + h11 * rates[to + i]));
        rate.push((1 - s) * rates[from + i] + s * rates[to + i]);
      }
      return {
        time: t,
        real,
        shown,
        omega: mix(omega, k, next, s),
        momentum: mix(momentum, k, next, s),
        joint,
        rate,
      };
    },
  };
}
