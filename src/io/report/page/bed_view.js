// The bed in three dimensions with its controls: what the colour means, where it is cut, how it is looked at.
import { card, choice, element } from './dom.js';
import { colourAt, extent, gradient } from './colour.js';
import { number, percent } from './format.js';
import { drawn } from './theme.js';
import { flatView } from './flat_view.js';
import { makeScene } from './scene.js';

/** What a pellet can be coloured by: values, scale, text of the two ends. */
function colourings(data) {
  const { pellets } = data;
  const height = Float32Array.from({ length: pellets.count }, (_, i) => pellets.position[3 * i + 2]);
  const all = [
    ['height', 'Height', { values: height, scale: 'viridis', range: extent(height), unit: (v) => `${number(1e3 * v, 0)} mm`, title: 'height above the floor' }],
    ['angle', 'Angle', { values: pellets.angle, scale: 'cividis', range: [0, 90], unit: (v) => `${number(v, 0)}°`, title: 'angle to the vertical' }],
  ];
  if (pellets.overlap) {
    all.push(['overlap', 'Overlap', { values: pellets.overlap, scale: 'ember', range: [0, extent(pellets.overlap)[1]], unit: percent, title: 'deepest overlap of the pellet, of its smallest thickness' }]);
  }
  return all;
}

function paint({ values, scale, range }) {
  const out = new Float32Array(3 * values.length);
  values.forEach((v, i) => out.set(colourAt(scale, (v - range[0]) / (range[1] - range[0])).map((c) => c / 255), 3 * i));
  return out;
}

function scaleBar() {
  const bar = element('div', { class: 'bar' });
  const ticks = element('div', { class: 'ticks' });
  const label = element('span', { class: 'label' });
  const node = element('div', { class: 'scale' }, label, bar, ticks);
  return { node, show(c) {
    label.textContent = c.title[0].toUpperCase() + c.title.slice(1);
    bar.style.background = gradient(c.scale);
    ticks.replaceChildren(...[0, 0.5, 1].map((t) => element('span', {}, c.unit(c.range[0] + t * (c.range[1] - c.range[0])))));
  } };
}

function cutControls(scene) {
  const slider = element('input', { type: 'range', min: 0, max: 1000, value: 500, 'aria-label': 'place of the cut', disabled: true });
  const place = element('output', { class: 'label' }, 'no cut');
  let axis = 'none';
  const apply = () => {
    slider.disabled = axis === 'none';
    const at = scene.cut(axis, slider.value / 1000);
    place.textContent = axis === 'none' ? 'no cut' : `cut at ${axis} = ${number(1e3 * at, 1)} mm`;
  };
  slider.addEventListener('input', apply);
  const options = [['none', 'Off'], ['x', 'x'], ['y', 'y'], ['z', 'z']];
  return element('div', {}, choice('Cut plane across', options, 'none', (value) => { axis = value; apply(); }), slider, place);
}

function viewButtons(scene) {
  const views = [['Corner', 'corner'], ['Front', 'front'], ['Top', 'top']];
  return element('div', {}, element('span', { class: 'label' }, 'Look from'), element('div', { class: 'views' },
    views.map(([text, name]) => element('button', { type: 'button', onclick: () => scene.look(name) }, text))));
}

function controls(data, scene) {
  const all = colourings(data);
  const bar = scaleBar();
  const show = (key) => {
    const chosen = all.find(([name]) => name === key)[2];
    scene.colours(paint(chosen));
    bar.show(chosen);
  };
  show('height');
  const parts = [choice('Colour', all.map(([key, text]) => [key, text]), 'height', show), bar.node];
  if (scene.cut) parts.push(cutControls(scene));
  if (scene.look) parts.push(viewButtons(scene));
  if (scene.container) {
    parts.push(element('label', { class: 'check' },
      element('input', { type: 'checkbox', checked: true, onchange: (event) => scene.container(event.target.checked) }), 'Container'));
  }
  return element('div', { class: 'controls' }, parts);
}

export function bedView(data) {
  if (data.pellets.count === 0) return card('The bed', '', element('p', {}, 'The bed is empty.'));
  const canvas = element('canvas', { tabindex: 0, role: 'img', 'aria-label':
    `The bed of ${data.pellets.count} pellets. Arrow keys turn it, plus and minus zoom.` });
  const stage = element('div', { class: 'stage' }, canvas);
  const section = card('The bed', '');
  let scene;
  try {
    scene = makeScene(canvas, data);
    stage.append(element('span', { class: 'hint' }, 'drag to turn · wheel to zoom · right drag to move · arrow keys'));
  } catch (error) {
    const flat = canvas.cloneNode(); // a canvas that was asked for WebGL gives nothing else
    canvas.replaceWith(flat);
    scene = flatView(flat, data);
    document.documentElement.dataset.flat = 'true';
    stage.append(element('span', { class: 'hint' }, 'no WebGL here: the bed from the front, not to be turned'));
  }
  section.append(element('div', { class: 'bed' }, stage, controls(data, scene)));
  drawn(scene.draw);
  return section;
}
