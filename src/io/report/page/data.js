// What packbed embedded: JSON whose arrays are little-endian typed arrays in base64.
function bytes(text) {
  const binary = atob(text);
  const out = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i += 1) out[i] = binary.charCodeAt(i);
  return out.buffer;
}

const KINDS = { f32: Float32Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array };

/** {"f32": "..."} becomes a Float32Array, wherever it stands. */
function decoded(value) {
  if (Array.isArray(value)) return value.map(decoded);
  if (value === null || typeof value !== 'object') return value;
  const keys = Object.keys(value);
  if (keys.length === 1 && KINDS[keys[0]]) return new KINDS[keys[0]](bytes(value[keys[0]]));
  return Object.fromEntries(keys.map((key) => [key, decoded(value[key])]));
}

/** Angle of every pellet's own z axis to the vertical [degree]; rotations are (x, y, z, w). */
function angles(rotation) {
  const out = new Float32Array(rotation.length / 4);
  for (let i = 0; i < out.length; i += 1) {
    const [x, y, z, w] = rotation.subarray(4 * i, 4 * i + 4);
    const ax = 2 * (x * z + w * y);
    const ay = 2 * (y * z - w * x);
    const az = 1 - 2 * (x * x + y * y);
    out[i] = Math.atan2(Math.hypot(ax, ay), Math.abs(az)) * 180 / Math.PI;
  }
  return out;
}

export function readData() {
  const data = decoded(JSON.parse(document.getElementById('data').textContent));
  data.pellets.angle = angles(data.pellets.rotation);
  return data;
}
