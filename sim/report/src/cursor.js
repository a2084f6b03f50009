// What charts over one axis share, and the replay: the place of the cursor on that axis, and the range on show.

/** A shared cursor on an axis from `start` to `end`; `log` where equal ratios are equally far apart. */
export function createCursor(start, end, log = false) {
  const listeners = { at: [], range: [] };
  const whole = [start, end > start ? end : start + 1];
  const [place, value] = log ? [Math.log, Math.exp] : [(v) => v, (p) => p];
  const ends = whole.map(place);
  // A range shorter than this share of the axis is not shown.
  const shortest = (ends[1] - ends[0]) * 1e-7;
  const state = { at: start, range: [...whole] };

  const emit = (kind) => listeners[kind].forEach((listener) => listener(state));

  return {
    whole,
    state,
    /** Whether the whole axis is on show. */
    isWhole: () => state.range[0] === whole[0] && state.range[1] === whole[1],
    onMove(listener) {
      listeners.at.push(listener);
    },
    onRange(listener) {
      listeners.range.push(listener);
    },
    moveTo(at) {
      const clamped = Math.min(Math.max(at, whole[0]), whole[1]);
      if (clamped === state.at) return;
      state.at = clamped;
      emit('at');
    },
    setRange(from, to) {
      const [a, b] = [place(Math.max(from, log ? whole[0] : -Infinity)), place(to)];
      const width = Math.min(Math.max(b - a, shortest), ends[1] - ends[0]);
      const left = Math.min(Math.max(ends[0], a), ends[1] - width);
      // At its ends the axis has its own numbers, which a logarithm would round.
      const range = [
        left === ends[0] ? whole[0] : value(left),
        left + width >= ends[1] ? whole[1] : value(left + width),
      ];
      if (range[0] === state.range[0] && range[1] === state.range[1]) return;
      state.range = range;
      emit('range');
    },
    /** The range divided by a factor, about the cursor if it is on show and about the middle if not. */
    zoom(factor) {
      const [from, to] = state.range.map(place);
      const at = place(state.at);
      const about = at >= from && at <= to ? at : (from + to) / 2;
      this.setRange(value(about - (about - from) / factor), value(about + (to - about) / factor));
    },
    showAll() {
      this.setRange(whole[0], whole[1]);
    },
    /** The range moved, where need be, so that the cursor is on show. */
    reveal() {
      const [from, to] = state.range.map(place);
      const [at, width] = [place(state.at), to - from];
      if (at < from) this.setRange(value(at - 0.1 * width), value(at + 0.9 * width));
      if (at > to) this.setRange(value(at - 0.9 * width), value(at + 0.1 * width));
    },
  };
}
