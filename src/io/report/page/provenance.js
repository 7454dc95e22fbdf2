// Where the bed comes from: pellets, container, references, the case itself.
import { card, element } from './dom.js';
import { mm, number, short } from './format.js';

const row = (head, ...text) => element('tr', {}, element('th', { scope: 'row' }, head), element('td', {}, ...text));

function shapeText(shape) {
  const size = shape.class === 'cylinder' ? `, ${mm(2 * shape.radius_m, 2)} × ${mm(2 * shape.half_height_m, 2)}`
    : shape.class === 'sphere' ? `, ${mm(2 * shape.radius_m, 2)}` : '';
  return `${shape.class}${size}; ${short(1e9 * shape.volume_m3, 4)} mm³, equal-volume sphere ${mm(shape.equivalent_diameter_m, 3)}, ${short(shape.density_kg_m3, 4)} kg/m³`;
}

function containerText(container) {
  const sizes = container.radius_m > 0 ? `, inner diameter ${mm(2 * container.radius_m, 2)}${container.height_m > 0 ? `, height ${mm(container.height_m)}` : ''}` : '';
  return `${container.kind}${sizes}`;
}

export function provenance(data) {
  const from = data.provenance;
  const rows = [
    row('case', from.case_file || data.title),
    row('program', `packbed ${from.version}, method ${from.method}, kernel ${from.kernel}, seed ${from.seed}`),
    row('bed', element('code', {}, data.bed_hash), ' (hash of ids, shapes and poses, bit for bit)'),
    ...data.shapes.map((shape) => row(`pellet ${shape.name}`, shapeText(shape), element('br'), element('code', {}, shape.source))),
    row(`container ${data.container.name}`, containerText(data.container), data.container.source ? element('br') : '', element('code', {}, data.container.source)),
    ...data.references.map((r) => row('reference', `${r.label}: ${number(r.mean, 3)} ± ${number(r.sd, 3)}. ${r.source}`)),
  ];
  return card('Provenance', '', element('div', { class: 'scroll' }, element('table', {}, element('tbody', {}, rows))),
    element('details', {}, element('summary', {}, 'The case as it was run, with all defaults'), element('pre', { tabindex: 0 }, from.case_text)),
    element('p', { class: 'note' }, 'Axes: z up, floor at z = 0, container axis through the origin. Every number of this page is in summary.json, bed.h5 and the CSV files beside it.'));
}
