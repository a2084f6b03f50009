// The legend of a chart: a table with each curve's line and mark, name, frame, value at the cursor, extremes
// and value at the end, then the limits. A curve's name is a button that hides the curve.

import { measuredAt, valuesAt } from './data.js';
import { element, spoken, symbol } from './dom.js';
import { interval, number } from './format.js';
import { LIMIT_DASH } from './palette.js';

const NAMESPACE = 'http://www.w3.org/2000/svg';

/** A piece of a line, with a cross where values were measured, as the chart draws it. */
function sample({ colour, dash, measured }) {
  const svg = document.createElementNS(NAMESPACE, 'svg');
  svg.setAttribute('width', '30');
  svg.setAttribute('height', '10');
  svg.setAttribute('aria-hidden', 'true');
  const line = document.createElementNS(NAMESPACE, 'path');
  line.setAttribute('d', 'M1 5H29');
  line.setAttribute('stroke-width', '2');
  if (dash.length > 0) line.setAttribute('stroke-dasharray', dash.join(' '));
  const cross = document.createElementNS(NAMESPACE, 'path');
  cross.setAttribute('d', measured ? 'M11 5H19M15 1V9' : '');
  cross.setAttribute('stroke-width', '1.5');
  svg.setAttribute('stroke', colour);
  svg.setAttribute('fill', 'none');
  svg.append(line, cross);
  return svg;
}

/** The row of a limit: its name, and the limit as it was written, in the column of the cursor. */
function limitRow({ label, written }, columns) {
  const svg = sample({ colour: 'currentColor', dash: LIMIT_DASH });
  const empty = Array.from({ length: columns - 1 }, () => element('td'));
  return element('tr', { class: 'limit' },
    element('th', { scope: 'row' }, element('span', { class: 'key' }, svg, element('span', { class: 'name' }, label))),
    element('td', {}, written), ...empty);
}

/** The legend's table on an axis; `changed` is called when a curve is hidden or shown. */
export function createLegend(curves, chart, axis, changed) {
  const hasMeasured = curves.some((curve) => curve.measured);
  const hasEnd = curves.some((curve) => curve.final);
  const body = element('tbody');
  const rows = curves.map((curve) => {
    const svg = sample(curve);
    const frame = curve.frame ? element('span', { class: 'frame' }, ` ${curve.frame}`) : '';
    const button = element('button', { type: 'button', 'aria-pressed': 'true', title: `Hide or show ${spoken(curve.label)}` },
      svg, element('span', { class: 'name' }, symbol(curve.label), frame));
    const cell = element('td', { class: 'now' });
    const found = element('td');
    const extremes = [curve.least, curve.most];
    if (hasEnd) extremes.push(curve.final[0] === curve.final[1] ? curve.final[0] : (curve.final[0] + curve.final[1]) / 2);
    const row = element('tr', {}, element('th', { scope: 'row' }, button), cell, ...(hasMeasured ? [found] : []),
      ...extremes.map((value) => element('td', {}, number(value, 4))));
    button.addEventListener('click', () => {
      curve.shown = !curve.shown;
      button.setAttribute('aria-pressed', String(curve.shown));
      row.classList.toggle('off', !curve.shown);
      changed();
    });
    body.append(row);
    return { curve, cell, found, svg };
  });
  const columns = ['cursor', ...(hasMeasured ? ['measured'] : []), 'min', 'max', ...(hasEnd ? ['end'] : [])];
  body.append(...chart.limits.map((limit) => limitRow(limit, columns.length)));
  const unit = chart.unit ? ` (${chart.unit})` : '';
  const head = element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, `Curve${unit}`),
    ...columns.map((text) => element('th', { scope: 'col', class: 'number' }, text))));
  const table = element('table', {}, head, body);
  const root = element('div', { class: 'legend', tabindex: '0', role: 'region', 'aria-label': `Values of ${chart.title} over the ${axis.noun}` }, table);

  return {
    root,
    /** The values at a place of the cursor. */
    show(at) {
      for (const { curve, cell, found } of rows) {
        cell.textContent = interval(valuesAt(curve, at));
        found.textContent = number(measuredAt(curve, at, axis.to - axis.from));
      }
    },
    recolour() {
      for (const { curve, svg } of rows) svg.setAttribute('stroke', curve.colour);
    },
  };
}
