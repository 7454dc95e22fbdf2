// Title, verdict and the headline numbers with their definition.
import { element } from './dom.js';
import { dash, duration, grouped, mm, number, percent } from './format.js';
import { toggleTheme } from './theme.js';

function verdict(run) {
  if (!run) return element('span', { class: 'badge' }, 'no run record');
  const failed = run.audit_lines.filter((line) => !line.passed).length;
  if (failed === 0) return element('a', { class: 'badge good', href: '#audit' }, '✓ audit passed');
  return element('a', { class: 'badge bad', href: '#audit' }, `✗ audit failed: ${failed} of ${run.audit_lines.length}`);
}

function tile(label, value, ...more) {
  return element('div', { class: 'tile' }, element('dt', {}, label), element('dd', {}, value),
    ...more.filter(Boolean).map((line) => element('dd', { class: 'more' }, line)));
}

function densityTile({ bulk }) {
  const best = Number.isFinite(bulk.packing_density) ? bulk.packing_density : bulk.exact;
  return tile('Packing density', number(best),
    Number.isFinite(bulk.axial_sd) ? `± ${number(bulk.axial_sd)} along the height` : null,
    Number.isFinite(bulk.packing_density) && Number.isFinite(bulk.exact) ? `${number(bulk.exact)} voxel-free` : null);
}

function referenceTile({ bulk, references }) {
  if (references.length === 0) return null;
  const best = Number.isFinite(bulk.packing_density) ? bulk.packing_density : bulk.exact;
  const [first] = references;
  const difference = best - first.mean;
  return tile(first.label, number(first.mean, 3), `± ${number(first.sd, 3)} along the height`,
    Number.isFinite(difference) ? `this bed: ${number(Math.abs(difference))} ${difference >= 0 ? 'above' : 'below'}` : null);
}

function tiles(data) {
  const { run, bulk } = data;
  const dp = bulk.diameter_m;
  return element('dl', { class: 'tiles' },
    densityTile(data),
    referenceTile(data),
    tile('Bed height', mm(data.bed_height_m), dp > 0 ? `${number(data.bed_height_m / dp, 1)} dp` : null),
    tile('Pellets', grouped(data.pellets.count),
      run ? `${grouped(run.pellets.asked)} asked, ${grouped(run.pellets.escaped)} escaped` : null,
      run ? (run.at_rest ? 'at rest' : 'not at rest') : null),
    run ? tile('Overlap at rest', percent(run.overlap.rest_max), `mean ${percent(run.overlap.rest_mean)}`,
      `${percent(run.overlap.peak)} at the hardest impact`) : null,
    run ? tile('Run time', duration(run.time.wall_s), `CPU ${duration(run.time.cpu_s)}`,
      `${run.threads} thread${run.threads === 1 ? '' : 's'}`) : null);
}

export function header(data) {
  const from = data.provenance;
  const facts = [`method ${from.method || dash}`, `kernel ${from.kernel || dash}`, `seed ${from.seed}`, `bed ${data.bed_hash}`];
  return element('header', {},
    element('div', { class: 'top' },
      element('p', { class: 'brand' }, 'packbed ', element('span', {}, from.version)),
      element('button', { type: 'button', class: 'quiet', onclick: toggleTheme }, 'Light / dark')),
    element('div', { class: 'title' }, element('h1', {}, data.title), verdict(data.run)),
    element('p', { class: 'facts' }, facts.join('  ·  ')),
    tiles(data),
    data.bulk.definition ? element('p', { class: 'definition' }, element('strong', {}, 'Packing density: '),
      `${data.bulk.definition.replace(/\.$/, '')}. ± is the standard deviation of the axial profile within the bed, not between beds.`) : null);
}
