// The report of one bed. Every section is a function of the data that packbed embedded in the page; the page says
// data-ready when all of them are drawn, and data-errors what went wrong.
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { readData } from './data.js';
import { element } from './dom.js';
import { header } from './header.js';
import { bedView } from './bed_view.js';
import { profiles } from './profiles.js';
import { structure } from './structure.js';
import { mixture } from './mixture.js';
import { audit, energy, timing, walls } from './run.js';
import { provenance } from './provenance.js';
import { onThemeChange } from './theme.js';

const root = document.documentElement;
const errors = [];
function note(error) {
  errors.push(String(error && error.message ? error.message : error));
  root.dataset.errors = errors.join(' | ');
}
window.addEventListener('error', (event) => note(event.error || event.message));
window.addEventListener('unhandledrejection', (event) => note(event.reason));

/** A section that fails says so in its place and leaves the others alone. */
function place(parent, name, make, data) {
  try {
    const part = make(data);
    if (part) parent.append(...[part].flat());
  } catch (error) {
    note(`${name}: ${error.message}`);
    console.error(error);
    parent.append(element('p', { class: 'card trouble' }, `The part “${name}” could not be drawn: ${error.message}`));
  }
}

function build() {
  const data = readData();
  const page = document.getElementById('page');
  place(page, 'header', header, data);
  const main = page.appendChild(element('main'));
  place(main, 'bed', bedView, data);
  place(main, 'profiles', profiles, data);
  place(main, 'structure', structure, data);
  const pair = main.appendChild(element('div', { class: 'columns two' }));
  place(pair, 'mixture', mixture, data);
  place(pair, 'audit', audit, data);
  place(pair, 'energy', energy, data);
  place(pair, 'walls', walls, data);
  place(pair, 'timing', timing, data);
  place(main, 'provenance', provenance, data);
  onThemeChange(); // first drawing of all figures in the colours of the day
}

build();
const ready = () => { root.dataset.ready = 'true'; };
requestAnimationFrame(() => requestAnimationFrame(ready));
setTimeout(ready, 2000); // a page that is not shown gets no frames
