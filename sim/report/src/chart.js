// One chart: a uPlot instance with the shared cursor, and the legend beside it.

import uPlot from 'uplot';
import { drawCurve, drawEvents } from './bands.js';
import { extremes, indexAt } from './data.js';
import { element, oncePerFrame, spoken } from './dom.js';
import { axisScale, axisUnit, number, powerOfTen, ticks } from './format.js';
import { createLegend } from './legend.js';
import { curveColour, curveDash, surface } from './palette.js';

const FAMILY = '"Segoe UI", "Helvetica Neue", Arial, "Liberation Sans", sans-serif';
const FONT = `12px ${FAMILY}`;
/** Above a linear range and below it, a share of it stays empty. */
const PADDING = 0.06;
/** Width of the vertical axis; the same for all charts, so that their times are below one another. */
const AXIS = 62;

/** The vertical range that shows every visible curve between two indices. */
function verticalRange(curves, from, to, log) {
  let least = Infinity;
  let most = -Infinity;
  for (const { low, high } of curves) {
    const [a, b] = extremes(low, high, from, to);
    if (a < least) least = a;
    if (b > most) most = b;
  }
  if (log) {
    // The smallest positive value decides on the lowest decade.
    let positive = Infinity;
    for (const { low, high } of curves) {
      for (let k = from; k <= to; k += 1) {
        const value = low[k] > 0 ? low[k] : high[k];
        if (value > 0 && value < positive) positive = value;
      }
    }
    if (!(most > 0)) return [1e-1, 1e1];
    const bottom = 10 ** Math.floor(Math.log10(positive) + 1e-9);
    const top = 10 ** Math.ceil(Math.log10(most) - 1e-9);
    return [bottom, top > bottom ? top : 10 * bottom];
  }
  if (!(least <= most)) return [0, 1];
  const padding = most > least ? PADDING * (most - least) : Math.abs(least) || 1;
  return [least - padding, most + padding];
}

/** A chart in `place`; `report` is the decoded data, `chart` its entry in the data. */
export function createChart(place, report, chart, cursor, theme) {
  const curves = chart.columns.map((index, n) => {
    const column = report.columns[index];
    const x = column.banded ? report.centres : report.time;
    return { ...column, x, dash: curveDash(n), colour: curveColour(n, theme.dark()), shown: true };
  });
  const log = chart.log === true;

  const unit = element('span', { class: 'unit' });
  const plot = element('div', {
    class: 'plot',
    tabindex: '0',
    role: 'application',
    'aria-roledescription': 'chart',
    'aria-label': `${spoken(chart.title)}${chart.unit ? `, in ${chart.unit}` : ''}, over time in s`,
    'aria-describedby': `${chart.id}-summary`,
  });
  const summary = curves.map((curve) => {
    const values = [curve.least, curve.most].map((value) => number(value));
    const final = range(curve.final);
    return `${spoken(curve.label)}: minimum ${values[0]}, maximum ${values[1]}, at the end ${final} ${curve.unit}.`;
  });
  const legend = createLegend(curves, chart, () => redraw());
  const root = element('div', { class: 'chart', id: chart.id, role: 'group', 'aria-label': chart.title },
    element('div', { class: 'chart-head' }, element('h3', {}, chart.title), unit),
    element('div', { class: 'chart-body' }, plot, legend.root),
    element('p', { class: 'spoken', id: `${chart.id}-summary` }, summary.join(' ')));
  place.after(root);

  const visible = () => curves.filter((curve) => curve.shown);
  let scale = { offset: 0, exponent: 0 };
  let first = 0;
  let last = report.time.length - 1;

  const colours = () => surface(theme.dark());
  const axis = {
    font: FONT,
    stroke: () => colours().ink,
    grid: { stroke: () => colours().hair, width: 1 },
    ticks: { stroke: () => colours().soft, width: 1, size: 4 },
    gap: 4,
  };
  const options = {
    width: Math.max(plot.clientWidth, 200),
    height: 230,
    // Right: half of the last tick's number.
    padding: [report.events.length > 0 ? 16 : 8, 20, 0, 0],
    legend: { show: false },
    cursor: {
      x: false,
      y: false,
      points: { show: false },
      drag: { x: true, y: false, setScale: false, dist: 5 },
      bind: { dblclick: () => null },
    },
    scales: {
      x: { time: false, range: () => cursor.state.range },
      y: { distr: log ? 3 : 1, range: () => verticalRange(visible(), first, last, log) },
    },
    axes: [
      { ...axis, size: 28, label: 'Time (s)', labelFont: FONT, labelSize: 18, labelGap: 0, values: (u, splits) => ticks(splits, axisScale(splits[0], splits.at(-1))) },
      {
        ...axis,
        size: AXIS,
        space: 24,
        values: (u, splits) => (log ? splits.map((value) => powerOfTen(Math.round(Math.log10(value)))) : ticks(splits, scale)),
        ...(log ? { splits: (u, index, low, high) => decades(low, high), filter: (u, splits) => splits } : {}),
      },
    ],
    series: [{}, ...curves.map(() => ({ paths: () => null, points: { show: false } }))],
    hooks: {
      setScale: [
        (u, key) => {
          if (key !== 'y' || log) return;
          scale = axisScale(u.scales.y.min, u.scales.y.max);
          unit.textContent = axisUnit(chart.unit, scale);
        },
      ],
      setSelect: [
        (u) => {
          const { left, width } = u.select;
          if (width < 5) return;
          const [from, to] = [u.posToVal(left, 'x'), u.posToVal(left + width, 'x')];
          u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
          cursor.setRange(from, to);
        },
      ],
      draw: [
        (u) => {
          const ratio = window.devicePixelRatio || 1;
          const { ctx, bbox } = u;
          ctx.save();
          drawEvents(u, report.events, colours(), `${11 * ratio}px ${FAMILY}`);
          ctx.beginPath();
          ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
          ctx.clip();
          for (const curve of visible()) drawCurve(u, curve, first, last);
          ctx.restore();
          // The scales that place the line are in force only now.
          placeLine();
        },
      ],
    },
  };
  if (log) unit.textContent = chart.unit;
  const data = [report.time, ...curves.map((curve) => curve.high)];
  const line = element('div', { class: 'cursor-line' });
  const u = new uPlot(options, data, plot);
  u.over.append(line);

  function redraw() {
    const [from, to] = cursor.state.range;
    first = Math.max(0, indexAt(report.time, from) - 1);
    last = Math.min(report.time.length - 1, indexAt(report.time, to) + 1);
    u.setScale('x', { min: from, max: to });
  }

  function placeLine() {
    if (line.parentNode === null) return;
    const { time, range: [from, to] } = cursor.state;
    const out = time < from || time > to;
    line.hidden = out;
    if (!out) line.style.transform = `translateX(${u.valToPos(time, 'x').toFixed(2)}px)`;
  }

  const follow = oncePerFrame(() => {
    placeLine();
    legend.show(bucketAt(report, cursor.state.time));
  });
  cursor.onTime(follow);
  cursor.onRange(oncePerFrame(redraw));
  theme.onChange(() => {
    curves.forEach((curve, n) => {
      curve.colour = curveColour(n, theme.dark());
    });
    legend.recolour();
    u.redraw(false, true);
  });

  const point = (event) => {
    const box = u.over.getBoundingClientRect();
    cursor.setTime(u.posToVal(event.clientX - box.left, 'x'));
  };
  u.over.addEventListener('pointermove', point);
  u.over.addEventListener('pointerdown', point);
  u.over.addEventListener('dblclick', () => cursor.showAll());

  new ResizeObserver(oncePerFrame(() => {
    const width = plot.clientWidth;
    if (width > 0 && width !== u.width) u.setSize({ width, height: 230 });
    placeLine();
  })).observe(plot);
  redraw();
  legend.show(bucketAt(report, cursor.state.time));

  /** The values at the cursor, as a sentence. */
  function values() {
    const k = bucketAt(report, cursor.state.time);
    return visible().map((c) => `${spoken(c.label)} ${range([c.low[k], c.high[k]])} ${c.unit}`).join('; ');
  }
  return { plot, title: chart.title, values, root, place, u };
}

/** One value, or two where they differ. */
function range([low, high]) {
  return low === high || Number.isNaN(low) ? number(low) : `${number(low)} to ${number(high)}`;
}

/** Ticks of a logarithmic axis: whole decades, eight at most. */
function decades(low, high) {
  const [from, to] = [Math.round(Math.log10(low)), Math.round(Math.log10(high))];
  const stride = Math.ceil((to - from) / 7);
  const all = [];
  for (let exponent = to; exponent >= from; exponent -= stride) all.unshift(10 ** exponent);
  return all;
}

/**
 * The bucket of an instant: the one that contains it, or, where no column has bands and the buckets are
 * samples, the nearest.
 */
export function bucketAt(report, time) {
  const k = indexAt(report.time, time);
  if (report.banded || k + 1 >= report.time.length) return k;
  return time - report.time[k] > report.time[k + 1] - time ? k + 1 : k;
}
