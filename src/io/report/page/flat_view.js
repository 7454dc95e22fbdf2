// Without WebGL: the bed from the front, pellet by pellet as discs, the far ones first.
import { colour } from './theme.js';

export function flatView(canvas, data) {
  const { position, shape, scale, count } = data.pellets;
  const order = Array.from({ length: count }, (_, i) => i).sort((a, b) => position[3 * b + 1] - position[3 * a + 1]);
  const radius = (i) => Math.cbrt(0.75 * data.shapes[shape[i]].volume_m3 / Math.PI) * (scale ? scale[i] : 1);
  let paint = null;

  function draw() {
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth * ratio;
    const height = canvas.clientHeight * ratio;
    if (!paint || width === 0) return;
    canvas.width = width;
    canvas.height = height;
    let [left, right, top] = [Infinity, -Infinity, 0];
    for (let i = 0; i < count; i += 1) {
      left = Math.min(left, position[3 * i] - radius(i));
      right = Math.max(right, position[3 * i] + radius(i));
      top = Math.max(top, position[3 * i + 2] + radius(i));
    }
    const zoom = 0.92 * Math.min(width / (right - left), height / top);
    if (!(zoom > 0)) throw new Error('the bed has no size');
    const floor = (height + zoom * top) / 2;
    const pen = canvas.getContext('2d');
    pen.fillStyle = colour('scene');
    pen.fillRect(0, 0, width, height);
    pen.strokeStyle = 'rgb(0 0 0 / 0.25)';
    for (const i of order) {
      pen.beginPath();
      pen.arc(width / 2 + zoom * (position[3 * i] - (left + right) / 2), floor - zoom * position[3 * i + 2],
        zoom * radius(i), 0, 2 * Math.PI);
      pen.fillStyle = `rgb(${[0, 1, 2].map((k) => Math.round(255 * paint[3 * i + k])).join(' ')})`;
      pen.fill();
      pen.stroke();
    }
  }
  return { draw, colours(values) { paint = values; draw(); } };
}
