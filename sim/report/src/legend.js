// The legend of a chart: a table with each curve's line, name, frame, values at the cursor, extremes
// and value at the end. A curve's name is a button that hides the curve.

import { element, spoken, symbol } from './dom.js';
import { number } from './format.js';

const NAMESPACE = 'http://www.w3.org/2000/svg';

function sample(curve) {
  const svg = document.createElementNS(NAMESPACE, 'svg');
  svg.setAttribute('width', '30');
  svg.setAttribute('height', '10');
  svg.setAttribute('aria-hidden', 'true');
  const line = document.createElementNS(NAMESPACE, 'path');
  line.setAttribute('d', 'M1 5H29');
  line.setAttribute('stroke', curve.colour);
  line.setAttribute('stroke-width', '2');
  line.setAttribute('fill', 'none');
  if (curve.dash.length > 0) line.setAttribute('stroke-dasharray', curve.dash.join(' '));
  svg.append(line);
  return { svg, line };
}

/** The legend's table; `changed` is called when a curve is hidden or shown. */
export function createLegend(curves, chart, changed) {
  const banded = curves.some((curve) => curve.banded);
  const body = element('tbody');
  const rows = curves.map((curve) => {
    const { svg, line } = sample(curve);
    const frame = curve.frame ? element('span', { class: 'frame' }, ` ${curve.frame}`) : '';
    const button = element('button', { type: 'button', 'aria-pressed': 'true', title: `Hide or show ${spoken(curve.label)}` },
      svg, element('span', { class: 'name' }, symbol(curve.label), frame));
    const cells = banded ? [element('td'), element('td')] : [element('td')];
    cells.forEach((cell) => cell.classList.add('now'));
    const final = curve.final[0] === curve.final[1] ? number(curve.final[0], 4) : number((curve.final[0] + curve.final[1]) / 2, 4);
    const row = element('tr', {}, element('th', { scope: 'row' }, button), ...cells,
      element('td', {}, number(curve.least, 4)), element('td', {}, number(curve.most, 4)), element('td', {}, final));
    button.addEventListener('click', () => {
      curve.shown = !curve.shown;
      button.setAttribute('aria-pressed', String(curve.shown));
      row.classList.toggle('off', !curve.shown);
      changed();
    });
    body.append(row);
    return { curve, cells, line };
  });
  const unit = chart.unit ? ` (${chart.unit})` : '';
  const head = banded
    ? element('thead', {},
      element('tr', {}, element('th', { scope: 'col', rowspan: '2' }, `Curve${unit}`),
        element('th', { scope: 'colgroup', colspan: '2', class: 'group' }, 'At the cursor'),
        element('th', { scope: 'colgroup', colspan: '3', class: 'group' }, 'Whole run')),
      element('tr', {}, ...['from', 'to', 'min', 'max', 'end'].map((text) => element('th', { scope: 'col', class: 'number' }, text))))
    : element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, `Curve${unit}`),
      ...['cursor', 'min', 'max', 'end'].map((text) => element('th', { scope: 'col', class: 'number' }, text))));
  const table = element('table', {}, head, body);
  const root = element('div', { class: 'legend', tabindex: '0', role: 'region', 'aria-label': `Values of ${chart.title}` }, table);

  return {
    root,
    /** The values of one bucket. */
    show(k) {
      for (const { curve, cells } of rows) {
        cells[0].textContent = number(curve.low[k]);
        if (cells.length > 1) cells[1].textContent = number(curve.high[k]);
      }
    },
    recolour() {
      for (const { curve, line } of rows) line.setAttribute('stroke', curve.colour);
    },
  };
}
