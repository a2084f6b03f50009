// All charts of the page: each takes the place of its static figure; a bar with the time of the cursor
// and the buttons for the range, in each section that has charts; the keys; what is read aloud.

import { bucketAt, createChart } from './chart.js';
import { element, oncePerFrame } from './dom.js';
import { instant } from './format.js';

/** Milliseconds after the last key before the values are read aloud. */
const PAUSE = 300;
const ZOOM = 1.6;

/** How the charts are used; said once. */
function instructions(report) {
  return element('p', { class: 'note screen' },
    'Drag across a chart to enlarge a span of time; a double click shows the whole run again. All charts '
    + 'and the replay share one cursor. On a chart with the focus: left and right arrows move the cursor '
    + '(with Shift ten steps), Home and End move it to the ends, plus and minus change the span, 0 shows '
    + 'the whole run. '
    + (report.banded ? 'A band covers all values between the least and the largest of each interval of '
      + 'the data, so no spike is left out.' : ''));
}

function bar(section, cursor, step) {
  const time = element('output', { class: 'time' });
  const range = element('span', { class: 'range' });
  const action = (text, label, act) => {
    const button = element('button', { type: 'button', 'aria-label': label }, text);
    button.addEventListener('click', act);
    return button;
  };
  const root = element('div', { class: 'bar', role: 'toolbar', 'aria-label': 'Time on show' },
    time,
    element('span', { class: 'buttons' },
      action('\u2212', 'Show a longer time', () => cursor.zoom(1 / ZOOM)),
      action('+', 'Show a shorter time', () => cursor.zoom(ZOOM)),
      action('Whole run', 'Show the whole run', () => cursor.showAll())),
    range);
  section.querySelector('h2').after(root);
  const showTime = oncePerFrame(() => {
    time.textContent = `Cursor at ${instant(cursor.state.time, step)} s`;
  });
  const showRange = oncePerFrame(() => {
    const [from, to] = cursor.state.range;
    const fine = Math.min(step, (to - from) / 100);
    range.textContent = `${instant(from, fine)} s to ${instant(to, fine)} s`;
  });
  cursor.onTime(showTime);
  cursor.onRange(showRange);
  showTime();
  showRange();
}

/** Moves the cursor by keys; true if the key was one of them. */
function moved(event, report, cursor) {
  const { time } = report;
  const k = bucketAt(report, cursor.state.time);
  const stride = event.shiftKey ? 10 : 1;
  const [from, to] = cursor.state.range;
  const at = (index) => time[Math.min(Math.max(index, 0), time.length - 1)];
  switch (event.key) {
    case 'ArrowLeft':
      cursor.setTime(cursor.state.time > time[k] && stride === 1 ? time[k] : at(k - stride));
      break;
    case 'ArrowRight':
      cursor.setTime(k === time.length - 1 ? cursor.whole[1] : at(k + stride));
      break;
    case 'Home':
      cursor.setTime(from);
      break;
    case 'End':
      cursor.setTime(to);
      break;
    default:
      return false;
  }
  return true;
}

/** Makes the charts; nothing where the page has no figures for them. */
export function createHistories(report, cursor, theme) {
  const { time } = report;
  const step = time.length > 1 ? (time[time.length - 1] - time[0]) / (time.length - 1) : 1;
  const live = element('div', { class: 'spoken', role: 'status', 'aria-live': 'polite' });
  document.body.append(live);

  const last = new Map();
  const charts = [];
  const sections = new Set();
  for (const chart of report.charts) {
    const figure = document.getElementById(chart.static);
    if (figure === null) continue;
    // Several charts of one figure stand in the order of the data.
    const made = createChart(last.get(figure) ?? figure, report, chart, cursor, theme);
    last.set(figure, made.root);
    figure.classList.add('replaced');
    charts.push(made);
    const section = figure.closest('section');
    if (section !== null && !sections.has(section)) {
      bar(section, cursor, step);
      if (sections.size === 0) section.querySelector('h2').after(instructions(report));
      sections.add(section);
    }
  }

  let timer = 0;
  let spokenTime = cursor.state.time;
  const announce = (chart) => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const now = cursor.state.time;
      const [from, to] = now > spokenTime ? [spokenTime, now] : [now, spokenTime];
      const passed = report.events.filter((event) => event.time > from && event.time <= to);
      const events = passed.map((event) => ` Passed at ${instant(event.time, step)} s: ${event.text}.`).join('');
      spokenTime = now;
      live.textContent = `${instant(now, step)} s. ${chart.values()}.${events}`;
    }, PAUSE);
  };

  for (const chart of charts) {
    chart.plot.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (moved(event, report, cursor)) {
        cursor.reveal();
        announce(chart);
      } else if (event.key === '+' || event.key === '=') cursor.zoom(ZOOM);
      else if (event.key === '-' || event.key === '_') cursor.zoom(1 / ZOOM);
      else if (event.key === '0' || event.key === 'Escape') cursor.showAll();
      else return;
      event.preventDefault();
    });
  }
  return charts;
}
