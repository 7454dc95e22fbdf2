// Making elements in one line.
const SVG = 'http://www.w3.org/2000/svg';

function fill(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

export function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

export function card(title, className, ...children) {
  return element('section', { class: `card ${className}`, 'aria-label': title }, element('h2', {}, title), ...children);
}

/** A picture with its caption; the caption is also what a screen reader says. */
export function figure(title, caption, ...children) {
  return element('figure', { class: 'card' }, element('h3', {}, title), ...children,
    caption ? element('figcaption', {}, caption) : null);
}

let groups = 0;
/** One choice of several, as a row of radio buttons: reached with Tab, changed with the arrow keys. */
export function choice(label, options, chosen, change) {
  const name = `choice${++groups}`;
  return element('fieldset', { class: 'choice' }, element('legend', {}, label),
    element('div', {}, options.map(([value, text]) => element('label', {},
      element('input', { type: 'radio', name, value, checked: value === chosen, onchange: () => change(value) }),
      element('span', {}, text)))));
}
