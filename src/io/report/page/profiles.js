// Packing density along the height and from the wall, with what others measured drawn in.
import uPlot from 'uplot';
import { element, figure } from './dom.js';
import { number } from './format.js';
import { colour, drawn } from './theme.js';

const HEIGHT = 320;

/** Horizontal band of the reference, vertical band of the section that the mean is taken over. */
function bands(references, section) {
  return (plot) => {
    const pen = plot.ctx;
    const { left, top, width, height } = plot.bbox;
    pen.save();
    pen.beginPath();
    pen.rect(left, top, width, height);
    pen.clip();
    if (section) {
      const [from, to] = section.map((x) => plot.valToPos(x, 'x', true));
      pen.fillStyle = colour('ink');
      pen.globalAlpha = 0.045;
      pen.fillRect(from, top, to - from, height);
    }
    for (const reference of references.slice(0, 1)) {
      const y = (value) => plot.valToPos(value, 'y', true);
      pen.fillStyle = colour('reference');
      pen.globalAlpha = 0.2;
      pen.fillRect(left, y(reference.mean + reference.sd), width, y(reference.mean - reference.sd) - y(reference.mean + reference.sd));
      pen.globalAlpha = 1;
      pen.strokeStyle = colour('reference');
      pen.lineWidth = 1.5 * devicePixelRatio;
      pen.setLineDash([7 * devicePixelRatio, 4 * devicePixelRatio]);
      pen.beginPath();
      pen.moveTo(left, y(reference.mean));
      pen.lineTo(left + width, y(reference.mean));
      pen.stroke();
    }
    pen.restore();
  };
}

function axis(label) {
  return { label, stroke: colour('soft'), labelSize: 26, font: '12px system-ui', labelFont: '13px system-ui',
    grid: { stroke: colour('line'), width: 1 }, ticks: { stroke: colour('line'), width: 1, size: 5 } };
}

function curves(profile) {
  const columns = [Array.from(profile.x_dp)];
  const series = [{}];
  const add = (values, label, ink, more) => {
    if (!values || values.length === 0) return;
    columns.push(Array.from(values, (v) => (Number.isFinite(v) ? v : null)));
    series.push({ label, stroke: colour(ink), points: { show: false }, value: (_, v) => number(v), ...more });
  };
  add(profile.density, 'voxels', 'accent', { width: 2 });
  add(profile.exact, 'voxel-free', 'second', { width: 1.5, dash: [6, 4] });
  return { columns, series };
}

function highest(columns) {
  let top = 0;
  for (const column of columns.slice(1)) for (const v of column) if (v > top) top = v;
  return Math.min(1.05, Math.max(0.7, 1.06 * top));
}

function chart(profile, [xLabel, shortLabel], references, section) {
  const holder = element('div', { class: 'plot' });
  let plot = null;
  drawn(() => {
    const width = holder.clientWidth;
    if (width === 0) return;
    if (plot) plot.destroy();
    const { columns, series } = curves(profile);
    series[0] = { label: xLabel.split(' ')[0], value: (_, v) => (v === null || v === undefined ? '–' : `${number(v, 2)} dp`) };
    plot = new uPlot({ width, height: HEIGHT, series, cursor: { points: { size: 7 } },
      scales: { x: { time: false }, y: { range: () => [0, highest(columns)] } },
      axes: [axis(width < 420 ? shortLabel : xLabel), axis('packing density')], hooks: { drawClear: [bands(references, section)] } }, columns, holder);
  });
  return holder;
}

function referenceNote(references) {
  if (references.length === 0) return 'No measured reference is known for these pellets in this container.';
  return `Green band: ${references[0].label}, mean ± standard deviation along the height. Source: ${references[0].source}.`;
}

export function profiles(data) {
  const { bulk, references } = data;
  const dp = bulk.diameter_m;
  const unit = dp > 0 ? `dp = ${number(1e3 * dp, 3)} mm` : 'dp';
  const section = dp > 0 && bulk.z_range_m[1] > bulk.z_range_m[0] ? bulk.z_range_m.map((z) => z / dp) : null;
  const parts = [];
  if (data.axial.x_dp.length > 0) {
    parts.push(figure('Axial profile', `Grey: the section that the mean is taken over. ${referenceNote(references)}`,
      chart(data.axial, [`height above the floor in pellet diameters, ${unit}`, 'height / dp'], references, section)));
  }
  if (data.radial.x_dp.length > 0) {
    parts.push(figure('Radial profile', 'Pellets line up along the wall: the density swings, and the swing dies out inwards.',
      chart(data.radial, [`distance from the wall in pellet diameters, ${unit}`, 'distance from the wall / dp'], references, null)));
  }
  return parts.length > 0 ? element('div', { class: 'columns two' }, parts) : null;
}
