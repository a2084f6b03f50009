// Colours of Okabe and Ito, and dashes. The order differs with the background: each colour of a row
// has a contrast of three to one or nearly so on its background, and keeps its hue where it can.

const CURVES = [
  { light: '#0072B2', dark: '#56B4E9' },
  { light: '#D55E00', dark: '#E06A0D' },
  { light: '#009E73', dark: '#1FB58A' },
  { light: '#CC79A7', dark: '#CC79A7' },
  { light: '#000000', dark: '#F0E442' },
  { light: '#E69F00', dark: '#E69F00' },
  { light: '#56B4E9', dark: '#FFFFFF' },
];

/** Lengths of strokes and gaps, in CSS pixels. */
const DASHES = [[], [8, 3], [2, 2.5], [9, 3, 2, 3], [14, 4], [4, 4], [9, 3, 2, 3, 2, 3], [5, 2]];

/** Dash of limits. */
export const LIMIT_DASH = [6, 3, 1, 3];

/** Colour of the nth curve of a chart. */
export function curveColour(n, dark) {
  const pair = CURVES[n % CURVES.length];
  return dark ? pair.dark : pair.light;
}

/** Dash of the nth curve of a chart; eight dashes and seven colours make 56 different curves. */
export function curveDash(n) {
  return DASHES[n % DASHES.length];
}

/** Colours of what is drawn on a canvas or in the replay, by background. */
export function surface(dark) {
  return dark
    ? { paper: '#16181C', ink: '#E4E4E6', soft: '#A3A4AB', hair: '#33363D', event: '#8E9099' }
    : { paper: '#FFFFFF', ink: '#1C1C1E', soft: '#5C5C62', hair: '#E3E3E6', event: '#8A8A8E' };
}

/** Colours of the replay's bodies and vectors. */
export const BODIES = {
  hub: '#8C97A8',
  ring: '#B8A070',
  wheel: '#9AA0AA',
  heavy: '#D55E00',
  plate: '#0072B2',
  ball: '#56B4E9',
  momentum: '#009E73',
  omega: '#CC79A7',
};
