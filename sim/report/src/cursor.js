// What all charts and the replay share: the time of the cursor, and the range of time on show.

/** A shared cursor over a run from `start` to `end`. */
export function createCursor(start, end) {
  const listeners = { time: [], range: [] };
  const whole = [start, end > start ? end : start + 1];
  // A range shorter than this share of the run is not shown.
  const shortest = (whole[1] - whole[0]) * 1e-7;
  const state = { time: start, range: [...whole] };

  const emit = (kind) => listeners[kind].forEach((listener) => listener(state));

  return {
    whole,
    state,
    onTime(listener) {
      listeners.time.push(listener);
    },
    onRange(listener) {
      listeners.range.push(listener);
    },
    setTime(time) {
      const clamped = Math.min(Math.max(time, whole[0]), whole[1]);
      if (clamped === state.time) return;
      state.time = clamped;
      emit('time');
    },
    setRange(from, to) {
      const width = Math.min(Math.max(to - from, shortest), whole[1] - whole[0]);
      let left = Math.max(whole[0], from);
      left = Math.min(left, whole[1] - width);
      if (left === state.range[0] && left + width === state.range[1]) return;
      state.range = [left, left + width];
      emit('range');
    },
    /** The range divided by a factor, about the cursor if it is on show and about the middle if not. */
    zoom(factor) {
      const [from, to] = state.range;
      const about = state.time >= from && state.time <= to ? state.time : (from + to) / 2;
      this.setRange(about - (about - from) / factor, about + (to - about) / factor);
    },
    showAll() {
      this.setRange(whole[0], whole[1]);
    },
    /** The range moved, where need be, so that the cursor is on show. */
    reveal() {
      const [from, to] = state.range;
      const width = to - from;
      if (state.time < from) this.setRange(state.time - 0.1 * width, state.time + 0.9 * width);
      if (state.time > to) this.setRange(state.time - 0.9 * width, state.time + 0.1 * width);
    },
  };
}
