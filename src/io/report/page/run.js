// What the run says of itself: audit, energy ledger, forces on the walls, time.
import { card, element } from './dom.js';
import { duration, grouped, percent, short, words } from './format.js';

const row = (head, ...cells) => element('tr', {}, element('th', { scope: 'row' }, head), ...cells);
const value = (text) => element('td', { class: 'value' }, text);

export function audit({ run }) {
  if (!run) return null;
  const lines = run.audit_lines.map((line) => element('tr', { class: line.passed ? null : 'bad' },
    element('td', { class: `mark ${line.passed ? 'good' : 'bad'}` }, line.passed ? '✓ passed' : '✗ failed'),
    element('th', { scope: 'row' }, line.name), element('td', {}, line.finding)));
  const part = card('Audit', '', element('div', { class: 'scroll' }, element('table', {}, element('tbody', {}, lines))),
    run.notes.length > 0 ? element('div', {}, element('p', { class: 'note' }, 'On the way:'), element('ul', { class: 'note' }, run.notes.map((text) => element('li', {}, text)))) : null);
  part.id = 'audit';
  return part;
}

const LEDGER = [['rubbed', 'lost to friction', '--second'], ['damped', 'lost to damping', '--accent'], ['removed', 'left with pellets taken out', '--faint'],
  ['potential', 'still height', '--reference'], ['elastic', 'stored in contacts', '--bad'], ['kinetic', 'still motion', '--good']];

export function energy({ run }) {
  if (!run || !(run.energy.input > 0)) return null;
  const e = run.energy;
  const share = (key) => Math.max(0, e[key] / e.input);
  const stack = element('div', { class: 'stack', role: 'img', 'aria-label': 'where the energy went' },
    LEDGER.map(([key, text, ink]) => element('span', { style: `width:${100 * share(key)}%;background:var(${ink})`, title: `${text}: ${percent(share(key), 3)}` })));
  const rows = LEDGER.map(([key, text, ink]) => row([element('span', { class: 'swatch', style: `background:var(${ink})` }), text],
    value(`${short(e[key])} J`), value(percent(share(key), 3))));
  return card('Energy ledger', '', stack, element('div', { class: 'scroll' }, element('table', {}, element('tbody', {},
    row('put in', value(`${short(e.input)} J`), value('')), ...rows, row('not accounted for', value(''), value(percent(e.ledger_error, 3)))))));
}

export function walls({ run }) {
  if (!run || !(run.wall.weight_N > 0)) return null;
  const { base_force_N: base, side_shear_N: side, weight_N: weight } = run.wall;
  const meter = (share) => element('td', { class: 'meter-cell' }, element('div', { class: 'meter', style: `width:${Math.min(100, Math.max(0, 100 * share))}%` }));
  return card('Forces on the container', '', element('table', {}, element('tbody', {},
    row('weight of the bed', meter(1), value(`${short(weight)} N`)),
    row('on the base', meter(base / weight), value(`${short(base)} N`)),
    row('up the side', meter(side / weight), value(`${short(side)} N`)))),
  element('p', { class: 'note' }, `Base and side together carry ${percent((base + side) / weight, 4)} of the weight.`));
}

export function timing({ run, analysis_time: analysis }) {
  if (!run) return null;
  const phases = Object.entries(run.time.phases_s).sort((a, b) => b[1] - a[1]);
  const most = phases.length > 0 ? phases[0][1] : 1;
  const rows = phases.map(([name, seconds]) => row(words(name),
    element('td', { class: 'meter-cell' }, element('div', { class: 'meter', style: `width:${100 * seconds / most}%` })), value(duration(seconds))));
  const memory = run.memory.peak_rss_bytes / 1e6;
  return card('Time', '', element('table', {}, element('tbody', {}, rows)),
    element('p', { class: 'note' }, `${grouped(run.time.steps)} steps of ${short(1e6 * run.time.step_s)} µs, ${short(run.time.simulated_s)} s simulated; `,
      `set-up ${duration(run.time.setup_s)}, voxels ${duration(analysis.voxelise_cpu_s)}, analysis ${duration(analysis.analyse_cpu_s)}; memory ${short(memory)} MB.`));
}
