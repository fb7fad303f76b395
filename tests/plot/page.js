// page.js PAGE: runs the script of a page that `stride plot` has drawn, on a canvas that only notes
// what is drawn, and moves and zooms as a user does.
'use strict';
const assert = require('assert');
const fs = require('fs');

const page = fs.readFileSync(process.argv[2], 'utf8');
const [, data] = page.match(/type="application\/json">([\s\S]*?)<\/script>/);
const [, code] = page.match(/<script>\n([\s\S]*?)<\/script>/);

let texts = [];
let lines = 0;
const drawn = {
  measureText: text => ({width: 6 * text.length}),
  fillText: text => texts.push(text),
};
for (const name of ['moveTo', 'lineTo', 'fillRect', 'strokeRect', 'rect'])
  drawn[name] = (...numbers) => {
    for (const number of numbers) assert(Number.isFinite(number), `${name}(${numbers})`);
    lines += name === 'lineTo' ? 1 : 0;
  };
for (const name of ['scale', 'beginPath', 'stroke', 'save', 'restore', 'clip']) drawn[name] = () => {};
const handlers = {};
const canvas = {
  clientWidth: 886, style: {}, getContext: () => drawn,  // 800 pixels of it are the picture
  addEventListener: (name, handler) => { handlers[name] = handler; },
  getBoundingClientRect: () => ({left: 0, width: 886}),
};
const window = {addEventListener: (name, handler) => { handlers['window ' + name] = handler; }};
const document = {getElementById: id => id === 'trace' ? {textContent: data} : canvas};
new Function('window', 'document', code)(window, document);

function redrawn(action) {
  texts = [];
  lines = 0;
  action();
  return texts;
}
const at = time => ({clientX: 70 + 800 * time / 4});

assert(texts.includes('Position [u]') && texts.includes('Velocity [u/s]') && texts.includes('Time [s]'));
assert(texts.includes('4') && lines > 800, `${lines} lines`);

// The cursor: the values of the row before it.
let shown = redrawn(() => handlers.mousemove(at(1.503)));
assert(shown.includes('Drive.fSetPosition = 2.25') && shown.includes('Main.Done = FALSE') && shown.includes('1.5'), shown);
shown = redrawn(() => handlers.mousemove(at(3.2049)));
assert(shown.includes('Main.Done = TRUE'), shown);
shown = redrawn(() => handlers.mouseleave());
assert(shown.includes('Main.Done'), shown);

// Drag from 1 s to 2 s: no ticks outside, and the range of what is to be seen.
handlers.mousedown(at(1));
handlers.mousemove(at(2));
shown = redrawn(() => handlers['window mouseup']());
assert(shown.includes('1.1') && shown.includes('2') && !shown.includes('0.5') && !shown.includes('15'), shown);
// In there the middle is 1.5 s.
shown = redrawn(() => handlers.mousemove(at(2)));
assert(shown.includes('Drive.fSetPosition = 2.25'), shown);
// Shift and drag a quarter of a second to later.
handlers.mousedown({...at(3), shiftKey: true});
handlers.mousemove(at(2));
handlers['window mouseup']();
shown = redrawn(() => handlers.mousemove(at(2)));
assert(shown.includes('Drive.fSetPosition = 3.0625') || shown.includes('Drive.fSetPosition = 3.0276'), shown);
// The wheel zooms about the cursor, a double-click shows all again.
const before = shown;
shown = redrawn(() => handlers.wheel({...at(2), deltaY: -1, preventDefault() {}}));
assert(shown.filter(text => text.startsWith('1.')).length !== 0);
assert.notDeepStrictEqual(shown, before);
shown = redrawn(() => handlers.dblclick());
assert(shown.includes('3.5') && shown.includes('0.5'), shown);
console.log('all as expected');
