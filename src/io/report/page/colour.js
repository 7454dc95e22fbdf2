// Colour scales that are even to the eye and readable without colour vision: stops after viridis, cividis and
// inferno of matplotlib (public domain, CC0).
const SCALES = {
  viridis: ['440154', '482878', '3e4989', '31688e', '26828e', '1f9e89', '35b779', '6ece58', 'b5de2b', 'fde725'],
  cividis: ['00224e', '123570', '3b496c', '575d6d', '707173', '8a8678', 'a59c74', 'c3b369', 'e1cc55', 'fee838'],
  ember: ['2a2f45', '4b3b6b', '7a4078', 'a8466f', 'd1585a', 'ec7a46', 'f8a441', 'fbd25f', 'fdf3b3'],
};

const stops = Object.fromEntries(Object.entries(SCALES).map(([name, list]) => [name,
  list.map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)))]));

/** [r, g, b] of 0 to 255 for t in [0, 1]. */
export function colourAt(scale, t) {
  const list = stops[scale];
  const x = Math.min(1, Math.max(0, t)) * (list.length - 1);
  const i = Math.min(list.length - 2, Math.floor(x));
  return list[i].map((c, k) => c + (x - i) * (list[i + 1][k] - c));
}

export const css = (rgb) => `rgb(${rgb.map(Math.round).join(' ')})`;

export function gradient(scale) {
  return `linear-gradient(to right, ${SCALES[scale].map((hex) => `#${hex}`).join(', ')})`;
}

/** Smallest and largest finite value; a flat range is widened. */
export function extent(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values) {
    if (!Number.isFinite(v)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (low > high) return [0, 1];
  return high > low ? [low, high] : [low, low + 1];
}
