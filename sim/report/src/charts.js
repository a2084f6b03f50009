// All charts of the page: each takes the place of its static figure; above the first one of an axis in a section, a bar with
// the place of the cursor and the buttons for the range; the keys; what is read aloud.

import { createChart } from './chart.js';
import { indexAt } from './data.js';
import { element, oncePerFrame } from './dom.js';
import { instant, plain } from './format.js';

/** Milliseconds after the last key before the values are read aloud. */
const PAUSE = 300;
const ZOOM = 1.6;

/** How the charts are used; said once. */
function instructions({ groups, replay }) {
  const [{ axis: { noun, whole } }] = groups;
  const single = groups.length === 1;
  const banded = groups.some(({ charts }) => charts.some(({ curves }) => curves.some((curve) => curve.banded)));
  return element('p', { class: 'note screen' },
    `Drag across a chart to enlarge a ${single ? `span of the ${noun}` : 'range'}; a double click shows the whole ${whole} again. `
    + (single ? `All charts${replay ? ' and the replay' : ''} share one cursor. ` : 'Charts over the same axis share one cursor. ')
    + 'The name of a curve hides it or shows it. On a chart with the focus: left and right arrows move the cursor '
    + '(with Shift ten steps), Home and End move it to the ends, plus and minus change the range, 0 shows '
    + `the whole ${whole}. `
    + (banded ? 'A band covers all values between the least and the largest of each interval of the data, so no spike is '
      + 'left out; the value at the cursor is that of a sample.' : ''));
}

/** A place on the axis as text, with the digits that tell steps apart. */
function places({ axis, stops }) {
  const step = stops.length > 1 ? (stops[stops.length - 1] - stops[0]) / (stops.length - 1) : 1;
  // A run has even steps.
  return (at, finer = step) => `${axis.noun === 'time' ? instant(at, Math.min(step, finer)) : plain(at, 5)} ${axis.unit}`.trim();
}

function bar(group, cursor, said) {
  const { noun, whole } = group.axis;
  const time = element('output', { class: 'time' });
  const range = element('span', { class: 'range' });
  const action = (text, label, act) => {
    const button = element('button', { type: 'button', 'aria-label': label }, text);
    button.addEventListener('click', act);
    return button;
  };
  const showTime = oncePerFrame(() => {
    time.textContent = `Cursor at ${said(cursor.state.at)}`;
  });
  const showRange = oncePerFrame(() => {
    const [from, to] = cursor.state.range;
    const fine = (to - from) / 100;
    range.textContent = `${said(from, fine)} to ${said(to, fine)}`;
  });
  cursor.onMove(showTime);
  cursor.onRange(showRange);
  showTime();
  showRange();
  return element('div', { class: 'bar', role: 'toolbar', 'aria-label': `Range of the ${noun} on show` },
    time,
    element('span', { class: 'buttons' },
      action('\u2212', `Show a wider range of the ${noun}`, () => cursor.zoom(1 / ZOOM)),
      action('+', `Show a narrower range of the ${noun}`, () => cursor.zoom(ZOOM)),
      action(`Whole ${whole}`, `Show the whole ${whole}`, () => cursor.showAll())),
    range);
}

/** Moves the cursor by keys; true if the key was one of them. */
function moved(event, { stops }, cursor) {
  const { at } = cursor.state;
  const k = indexAt(stops, at);
  const stride = event.shiftKey ? 10 : 1;
  const [from, to] = cursor.state.range;
  const stop = (index) => stops[Math.min(Math.max(index, 0), stops.length - 1)];
  switch (event.key) {
    case 'ArrowLeft':
      cursor.moveTo(at > stops[k] && stride === 1 ? stops[k] : stop(k - stride));
      break;
    case 'ArrowRight':
      cursor.moveTo(stop(k + stride));
      break;
    case 'Home':
      cursor.moveTo(from);
      break;
    case 'End':
      cursor.moveTo(to);
      break;
    default:
      return false;
  }
  return true;
}

/** A function that says, a while after the last call, where the cursor is, the values of a chart, and the events passed. */
function announcer({ events }, cursor, said, live) {
  let timer = 0;
  let last = cursor.state.at;
  return (chart) => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const now = cursor.state.at;
      const [from, to] = now > last ? [last, now] : [now, last];
      const passed = events.filter((event) => event.time > from && event.time <= to);
      const words = passed.map((event) => ` Passed at ${said(event.time)}: ${event.text}.`).join('');
      last = now;
      live.textContent = `${said(now)}. ${chart.values()}.${words}`;
    }, PAUSE);
  };
}

function listen(chart, group, cursor, announce) {
  chart.plot.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (moved(event, group, cursor)) {
      cursor.reveal();
      announce(chart);
    } else if (event.key === '+' || event.key === '=') cursor.zoom(ZOOM);
    else if (event.key === '-' || event.key === '_') cursor.zoom(1 / ZOOM);
    else if (event.key === '0' || event.key === 'Escape') cursor.showAll();
    else return;
    event.preventDefault();
  });
}

/** Makes the charts; nothing where the page has no figures for them. */
export function createCharts(report, cursors, theme) {
  const live = element('div', { class: 'spoken', role: 'status', 'aria-live': 'polite' });
  const last = new Map();
  let first = null;
  report.groups.forEach((group, index) => {
    if (group.stops.length === 0) return;
    const cursor = cursors[index];
    const said = places(group);
    const announce = announcer(group, cursor, said, live);
    const sections = new Set();
    for (const chart of group.charts) {
      const figure = document.getElementById(chart.static);
      if (figure === null) continue;
      const section = figure.closest('section');
      const isFirst = section !== null && !sections.has(section);
      // Several charts of one figure stand in the order of the data.
      const before = last.get(figure) ?? figure;
      const made = createChart(before, group, chart, cursor, theme);
      if (isFirst) {
        sections.add(section);
        before.after(bar(group, cursor, said));
      }
      last.set(figure, made.root);
      figure.classList.add('replaced');
      listen(made, group, cursor, announce);
      if (first === null || (figure.compareDocumentPosition(first) & Node.DOCUMENT_POSITION_FOLLOWING)) first = figure;
    }
  });
  if (first === null) return;
  document.body.append(live);
  first.before(instructions({ ...report, groups: report.groups.filter(({ charts }) => charts.length > 0) }));
}
