// One chart: a uPlot instance with the cursor of its axis, and the legend beside it.

import uPlot from 'uplot';
import { drawCurve, drawEvents, drawLimit } from './bands.js';
import { indexAt, nearest, valuesAt } from './data.js';
import { element, oncePerFrame, spoken } from './dom.js';
import { axisScale, axisUnit, interval, number, ticks } from './format.js';
import { createLegend } from './legend.js';
import { decades, powers, verticalRange } from './range.js';
import { curveColour, curveDash, LIMIT_DASH, surface } from './palette.js';

const FAMILY = '"Segoe UI", "Helvetica Neue", Arial, "Liberation Sans", sans-serif';
const FONT = `12px ${FAMILY}`;
/** Width of the vertical axis; the same for all charts, so that their times are below one another. */
const AXIS = 62;

/** Limits are in the colour of the text. */
function colourOf(curve, n, theme) {
  return curve.limit ? surface(theme.dark()).ink : curveColour(n, theme.dark());
}

/** A chart in `place`; `group` is the decoded group of the charts of one axis, `chart` one of them. */
export function createChart(place, group, chart, cursor, theme) {
  const { axis: across, events } = group;
  const curves = chart.curves.map((curve, n) => (
    { ...curve, dash: curve.limit ? LIMIT_DASH : curveDash(n), colour: colourOf(curve, n, theme), shown: true }));
  const log = chart.log === true;

  const unit = element('span', { class: 'unit' });
  const plot = element('div', {
    class: 'plot',
    tabindex: '0',
    role: 'application',
    'aria-roledescription': 'chart',
    'aria-label': `${spoken(chart.title)}${chart.unit ? `, in ${chart.unit}` : ''}, over the ${across.noun}${across.unit ? ` in ${across.unit}` : ''}`,
    'aria-describedby': `${chart.id}-summary`,
  });
  const summary = curves.map((curve) => {
    const values = [curve.least, curve.most].map((value) => number(value));
    const final = curve.final ? `, at the end ${interval(curve.final, ' to ')}` : '';
    return `${spoken(curve.label)}: minimum ${values[0]}, maximum ${values[1]}${final} ${curve.unit}.`;
  });
  const legend = createLegend(curves, chart, across, () => redraw());
  const root = element('div', { class: 'chart', id: chart.id, role: 'group', 'aria-label': chart.title },
    element('div', { class: 'chart-head' }, element('h3', {}, chart.title), unit),
    element('div', { class: `chart-body${curves.some((curve) => curve.final) ? '' : ' few'}` }, plot, legend.root),
    element('p', { class: 'spoken', id: `${chart.id}-summary` }, summary.join(' ')));
  place.after(root);

  const visible = () => curves.filter((curve) => curve.shown);
  let scale = { offset: 0, exponent: 0 };
  /** The first and the last index of a curve on show, with one more on each side. */
  const shownOf = ({ x }) => {
    const [from, to] = cursor.state.range;
    return [Math.max(0, indexAt(x, from) - 1), Math.min(x.length - 1, indexAt(x, to) + 1)];
  };

  const colours = () => surface(theme.dark());
  const axis = {
    font: FONT,
    stroke: () => colours().ink,
    grid: { stroke: () => colours().hair, width: 1 },
    ticks: { stroke: () => colours().soft, width: 1, size: 4 },
    gap: 4,
  };
  const logarithmic = {
    splits: (u, index, low, high) => decades(low, high),
    filter: (u, splits) => splits,
    values: (u, splits) => powers(splits),
  };
  const options = {
    width: Math.max(plot.clientWidth, 200),
    height: 230,
    // Right: half of the last tick's number.
    padding: [events.length > 0 ? 16 : 8, 20, 0, 0],
    legend: { show: false },
    cursor: {
      x: false,
      y: false,
      points: { show: false },
      drag: { x: true, y: false, setScale: false, dist: 5 },
      bind: { dblclick: () => null },
    },
    scales: {
      x: { time: false, distr: across.log ? 3 : 1, range: () => cursor.state.range },
      y: { distr: log ? 3 : 1, range: () => verticalRange(chart, visible(), shownOf, cursor.isWhole()) },
    },
    axes: [
      {
        ...axis,
        size: 28,
        label: `${across.name}${across.unit ? ` (${across.unit})` : ''}`,
        labelFont: FONT,
        labelSize: 18,
        labelGap: 0,
        ...(across.log ? logarithmic : { values: (u, splits) => ticks(splits, axisScale(splits[0], splits.at(-1))) }),
      },
      { ...axis, size: AXIS, space: 24, ...(log ? logarithmic : { values: (u, splits) => ticks(splits, scale) }) },
    ],
    series: [{}, { paths: () => null, points: { show: false } }],
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
          drawEvents(u, events, colours(), `${11 * ratio}px ${FAMILY}`);
          ctx.beginPath();
          ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
          ctx.clip();
          for (const limit of chart.limits) drawLimit(u, limit, colours());
          for (const curve of visible()) drawCurve(u, curve, ...shownOf(curve));
          ctx.restore();
          // The scales that place the line are in force only now.
          placeLine();
        },
      ],
    },
  };
  if (log) unit.textContent = chart.unit;
  // The curves are ours; the library places axes only, and asks for a range where there is a value.
  const data = [chart.stops, chart.stops.map(() => 1)];
  const line = element('div', { class: 'cursor-line' });
  const u = new uPlot(options, data, plot);
  u.over.append(line);

  function redraw() {
    const [from, to] = cursor.state.range;
    u.setScale('x', { min: from, max: to });
  }

  function placeLine() {
    if (line.parentNode === null) return;
    const { at, range: [from, to] } = cursor.state;
    const out = at < from || at > to;
    line.hidden = out;
    if (!out) line.style.transform = `translateX(${u.valToPos(at, 'x').toFixed(2)}px)`;
  }

  const follow = oncePerFrame(() => {
    placeLine();
    legend.show(cursor.state.at);
  });
  cursor.onMove(follow);
  cursor.onRange(oncePerFrame(redraw));
  theme.onChange(() => {
    curves.forEach((curve, n) => {
      curve.colour = colourOf(curve, n, theme);
    });
    legend.recolour();
    u.redraw(false, true);
  });

  const point = (event) => {
    const box = u.over.getBoundingClientRect();
    // At a sample, so that its values are those at the cursor.
    cursor.moveTo(chart.stops[nearest(chart.stops, u.posToVal(event.clientX - box.left, 'x'))]);
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
  follow();

  /** The values at the cursor, as a sentence. */
  function values() {
    const at = (curve) => interval(valuesAt(curve, cursor.state.at), ' to ');
    return visible().map((c) => `${spoken(c.label)} ${at(c)} ${c.unit}`).join('; ');
  }
  return { plot, title: chart.title, values, root, place, u };
}
