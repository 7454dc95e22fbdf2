// The core of the bed, and what many sizes make of it.
import { card, element } from './dom.js';
import { grouped, mm, number, percent, short } from './format.js';

const row = (head, ...cells) => element('tr', {}, element('th', { scope: 'row' }, head), ...cells);
const value = (text) => element('td', { class: 'value' }, text);

function core({ core: c, segregation, coordination }) {
  const rows = [];
  if (c && Number.isFinite(c.exact)) rows.push(row('porosity, exact', value(number(c.exact))));
  if (c && Number.isFinite(c.voxels)) rows.push(row('porosity, from voxels', value(number(c.voxels))));
  if (c && Number.isFinite(c.shots)) {
    rows.push(row(`porosity, ${grouped(c.shots_per_cell)} shots in each of ${grouped(c.cells)} cells of ${mm(c.cell_m, 2)}`,
      value(`${number(c.shots)} ± ${short(c.shots_error, 2)}`)));
  }
  if (coordination) {
    rows.push(row('touching pellets of a pellet', value(number(coordination.mean, 2))));
    if (Number.isFinite(coordination.core_bearing)) rows.push(row('the same in the core, rattlers aside', value(number(coordination.core_bearing, 2))));
    rows.push(row('rattlers: fewer than four contacts', value(grouped(coordination.rattlers))));
  }
  if (Number.isFinite(segregation)) rows.push(row('segregation (+1: all larger ones above)', value(number(segregation))));
  if (rows.length === 0) return null;
  return card('Core and contacts', '', element('table', {}, element('tbody', {}, rows)),
    c ? element('p', { class: 'note' }, `${c.definition}.`) : null);
}

function sizes({ sizes: rows }) {
  if (!rows || rows.length === 0) return null;
  const most = Math.max(...rows.map((r) => r.volume));
  const lines = rows.map((r) => row(r.to_m > r.from_m * (1 + 1e-9) ? `${number(1e3 * r.from_m, 2)} to ${mm(r.to_m, 2)}` : mm(r.diameter_m, 2),
    value(grouped(r.count)), value(percent(r.number, 3)), value(percent(r.asked_number, 3)),
    element('td', { class: 'meter-cell' }, element('div', { class: 'meter', style: `width:${100 * r.volume / most}%` })),
    value(percent(r.volume, 3)), value(percent(r.asked_volume, 3))));
  const head = ['size', 'pellets', 'by number', 'asked', '', 'by volume', 'asked'];
  return card('Sizes', '', element('div', { class: 'scroll' }, element('table', {},
    element('thead', {}, element('tr', {}, head.map((text) => element('th', { scope: 'col' }, text)))),
    element('tbody', {}, lines))));
}

export function mixture({ mixture: m }) {
  return [core(m), sizes(m)].filter(Boolean);
}
