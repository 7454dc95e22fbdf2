// How the bed is built across: column averages, and how its pellets lie.
import { element, figure, svg } from './dom.js';
import { colourAt, gradient } from './colour.js';
import { mm, number } from './format.js';
import { colour, drawn } from './theme.js';

function sized(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const side = Math.round(canvas.clientWidth * ratio);
  if (side === 0) return null;
  canvas.width = side;
  canvas.height = side;
  return { pen: canvas.getContext('2d'), side, ratio };
}

function planarMap(map) {
  const canvas = element('canvas', { class: 'square', role: 'img', 'aria-label': 'packing density averaged over the height, seen from above' });
  const picture = element('canvas', { width: map.size[0], height: map.size[1] });
  const pen = picture.getContext('2d');
  const pixels = pen.createImageData(map.size[0], map.size[1]);
  map.density.forEach((value, i) => {
    const row = map.size[1] - 1 - Math.floor(i / map.size[0]); // y upwards
    const at = 4 * (row * map.size[0] + i % map.size[0]);
    if (value === 255) return; // outside the container
    pixels.data.set([...colourAt('viridis', value / 254).map(Math.round), 255], at);
  });
  pen.putImageData(pixels, 0, 0);
  drawn(() => {
    const target = sized(canvas);
    if (!target) return;
    target.pen.imageSmoothingEnabled = false;
    const zoom = target.side / Math.max(...map.size);
    const [width, height] = map.size.map((n) => n * zoom);
    target.pen.drawImage(picture, (target.side - width) / 2, (target.side - height) / 2, width, height);
  });
  const bar = element('div', { style: 'margin-top:10px' }, element('div', { class: 'bar', style: `background:${gradient('viridis')}` }),
    element('div', { class: 'ticks' }, ...[0, 0.5, 1].map((t) => element('span', {}, number(t, 1)))));
  return figure('Planar map', `Packing density averaged along the height, seen from above; ${mm(map.pitch, 2)} a cell.`, canvas, bar);
}

function histogram(o) {
  const [width, height, left, bottom, top] = [340, 300, 44, 46, 10];
  const most = 1.12 * Math.max(...o.fraction, ...o.isotropic);
  const x = (deg) => left + (width - left - 6) * deg / 90;
  const y = (f) => height - bottom - (height - bottom - top) * f / most;
  const chart = svg('svg', { viewBox: `0 0 ${width} ${height}`, class: 'chart', role: 'img', 'aria-label': 'histogram of the angle between pellet axis and vertical' });
  for (let f = 0; f <= most; f += 0.05) {
    chart.append(svg('line', { class: 'axis', x1: left, x2: width - 6, y1: y(f), y2: y(f) }),
      svg('text', { x: left - 6, y: y(f) + 4, 'text-anchor': 'end' }, number(f, 2)));
  }
  o.fraction.forEach((f, i) => chart.append(svg('rect', { x: x(o.from_deg[i]) + 1.5, width: x(o.to_deg[i]) - x(o.from_deg[i]) - 3, y: y(f), height: y(0) - y(f), fill: 'var(--accent)', rx: 2 },
    svg('title', {}, `${o.from_deg[i]}° to ${o.to_deg[i]}°: ${o.count[i]} pellets, ${number(f, 3)}; isotropic ${number(o.isotropic[i], 3)}`))));
  const steps = o.isotropic.flatMap((f, i) => [`${x(o.from_deg[i])},${y(f)}`, `${x(o.to_deg[i])},${y(f)}`]);
  chart.append(svg('polyline', { points: steps.join(' '), fill: 'none', stroke: 'var(--second)', 'stroke-width': 2 }));
  for (const deg of [0, 30, 60, 90]) chart.append(svg('text', { x: x(deg), y: height - bottom + 18, 'text-anchor': deg === 90 ? 'end' : 'middle' }, `${deg}°`));
  chart.append(svg('text', { x: (left + width) / 2, y: height - 8, 'text-anchor': 'middle' }, 'angle of the pellet axis to the vertical'));
  return figure('Orientation', 'Bars: fraction of the pellets in each class. Line: what uniformly random axes would give.', chart);
}

function lambertDisc(points) {
  const canvas = element('canvas', { class: 'square', role: 'img', 'aria-label': 'equal-area projection of the pellet axes, lower hemisphere' });
  drawn(() => {
    const target = sized(canvas);
    if (!target) return;
    const { pen, side, ratio } = target;
    const r = 0.46 * side;
    pen.translate(side / 2, side / 2);
    pen.clearRect(-side / 2, -side / 2, side, side);
    pen.strokeStyle = colour('faint');
    pen.lineWidth = 0.7 * ratio;
    pen.fillStyle = colour('soft');
    pen.font = `${11 * ratio}px system-ui`;
    for (const deg of [30, 60, 90]) {
      const ring = r * Math.SQRT2 * Math.sin(deg * Math.PI / 360); // Lambert: equal areas on the sphere and here
      pen.beginPath();
      pen.arc(0, 0, ring, 0, 2 * Math.PI);
      pen.stroke();
    }
    pen.beginPath();
    pen.moveTo(-r, 0); pen.lineTo(r, 0); pen.moveTo(0, -r); pen.lineTo(0, r);
    pen.stroke();
    const count = points.length / 2;
    const dot = ratio * (count > 1500 ? 1.5 : 2.2);
    pen.fillStyle = colour('accent');
    pen.globalAlpha = count > 1500 ? 0.55 : 0.75;
    for (let i = 0; i < count; i += 1) {
      pen.beginPath();
      pen.arc(r * points[2 * i], -r * points[2 * i + 1], dot, 0, 2 * Math.PI);
      pen.fill();
    }
    pen.globalAlpha = 1;
    pen.fillStyle = colour('soft');
    for (const deg of [30, 60]) pen.fillText(`${deg}°`, 4 * ratio, -r * Math.SQRT2 * Math.sin(deg * Math.PI / 360) - 3 * ratio);
  });
  return figure('Directions of the axes', 'Lambert equal-area projection, lower hemisphere: upright pellets in the middle, lying ones at the rim; even cover means no preferred direction.', canvas);
}

export function structure(data) {
  const parts = [];
  if (data.planar) parts.push(planarMap(data.planar));
  if (data.orientation && data.orientation.count.length > 0) {
    parts.push(histogram(data.orientation));
    if (data.orientation.lambert.length > 0) parts.push(lambertDisc(data.orientation.lambert));
  }
  return parts.length > 0 ? element('div', { class: 'columns three' }, parts) : null;
}
