// Numbers for people.
const MINUS = '\u2212';
const THIN = '\u202f';

export const dash = '\u2013';

export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return dash;
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? text.replace('-', '') : text).replace('-', MINUS);
}

/** About `digits` significant digits, without needless zeros or exponents. */
export function short(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return dash;
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) {
    const text = Number(value.toPrecision(digits)).toString();
    return (size >= 1e4 ? grouped(Math.round(value)) : text).replace('-', MINUS);
  }
  const [mantissa, power] = value.toExponential(digits - 1).split('e');
  return `${mantissa}·10${superscript(Number(power))}`.replace('-', MINUS);
}

function superscript(power) {
  const digits = '⁰¹²³⁴⁵⁶⁷⁸⁹';
  return (power < 0 ? '⁻' : '') + [...String(Math.abs(power))].map((d) => digits[d]).join('');
}

export function grouped(value) {
  return String(value).replace(/\B(?=(\d{3})+(?!\d))/g, THIN);
}

export const percent = (fraction, digits = 2) => (Number.isFinite(fraction) ? `${short(100 * fraction, digits)}${THIN}%` : dash);
export const mm = (metres, digits = 1) => `${number(1e3 * metres, digits)}${THIN}mm`;

export function duration(seconds) {
  if (!Number.isFinite(seconds)) return dash;
  if (seconds < 60) return `${short(seconds)}${THIN}s`;
  const whole = Math.round(seconds);
  if (whole < 3600) return `${Math.floor(whole / 60)}${THIN}min ${whole % 60}${THIN}s`;
  return `${Math.floor(whole / 3600)}${THIN}h ${Math.floor(whole / 60) % 60}${THIN}min`;
}

export const words = (name) => name.replaceAll('_', ' ');
