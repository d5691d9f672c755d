// SPDX-License-Identifier: BSD-3-Clause
import { pointAt } from './choosing.js';
import { Connection } from './connection.js';
import { drawDepth } from './depth_image.js';
import { showBanner, showCounters, showFrame, showRange } from './panel.js';
import { download, plyOf } from './ply.js';
import { Plots } from './plots.js';
import { Scene } from './scene.js';
import { showSettings } from './settings.js';
import { mapColour } from './theme.js';

const byId = (id) => document.getElementById(id);
const scene = makeScene();
const plots = new Plots(byId('plots'));

let names = null; // What the server said of itself.
let objects = []; // What is known of each: {frames, surface, flow, depth, status}.
let chosen = 0;
let link = 'lost';

/** All but the scene works without WebGL too. */
function makeScene() {
  try {
    return new Scene(byId('view'));
  } catch {
    byId('empty').textContent = 'This browser has no WebGL: the surface cannot be drawn, only saved.';
    const nothing = () => {};
    return { clear: nothing, addFrames: nothing, setSurface: nothing, setFlow: nothing, show: nothing, home: nothing, missing: true };
  }
}

const connection = new Connection({
  message: (message) => (message.kind === 'hello' ? begin(message) : take(message)),
  state: (state) => {
    link = state;
    showLink();
  },
});

/** The server tells its minute of history next: all that is here is out of date. */
function begin(hello) {
  names = hello;
  objects = hello.objects.map(() => ({ frames: [], surface: null, status: null }));
  byId('program').textContent = `disflow_track ${hello.version}`;
  showChooser();
  plots.setStages(hello.stages);
  choose(Math.min(chosen, objects.length - 1));
}

function take(message) {
  const object = objects[message.object];
  if (!object) return;
  if (message.kind === 'frames') {
    object.frames.push(...message.frames);
    if (object.frames.length > 2400) object.frames.splice(0, object.frames.length - 1800);
  } else {
    object[message.kind] = message;
  }
  if (message.object === chosen) show(message);
}

function show(message) {
  const object = objects[chosen];
  switch (message.kind) {
    case 'frames':
      scene.addFrames(message.frames);
      plots.add(message.frames);
      showFrame(message.frames.at(-1), names, object.status?.frames_per_second ?? 0);
      break;
    case 'surface':
      scene.setSurface(message);
      showRange(message);
      byId('empty').hidden = message.indices.length > 0 && !scene.missing;
      byId('save').disabled = message.indices.length === 0;
      byId('scene').dataset.triangles = message.indices.length / 3;
      break;
    case 'flow':
      scene.setFlow(message);
      break;
    case 'depth':
      drawDepth(byId('depth'), message);
      byId('depth-range').textContent = `${message.near.toFixed(2)} to ${message.far.toFixed(2)} m`;
      break;
    case 'settings':
      showSettings(byId('setting-values'), message.settings, (number, value) => connection.set(chosen, number, value));
      break;
    case 'status':
      showCounters(message);
      showLink();
      break;
  }
}

function choose(object) {
  chosen = object;
  scene.clear();
  plots.clear();
  byId('empty').hidden = false;
  byId('save').disabled = true;
  for (const [i, button] of [...byId('objects').children].entries()) button.ariaPressed = String(i === chosen);
  const known = objects[chosen];
  if (known.frames.length > 0) show({ kind: 'frames', frames: known.frames });
  for (const kind of ['surface', 'flow', 'depth', 'settings', 'status']) if (known[kind]) show(known[kind]);
}

function showChooser() {
  const buttons = names.objects.map((name, i) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = name;
    button.onclick = () => choose(i);
    return button;
  });
  byId('objects').replaceChildren(...buttons);
  byId('objects').hidden = buttons.length < 2;
}

function showLink() {
  const status = objects[chosen]?.status;
  document.body.dataset.link = link;
  const open = link === 'open';
  byId('pause').textContent = status?.paused ? 'Resume' : 'Pause';
  byId('pause').disabled = byId('reset').disabled = byId('choose').disabled = !open || Boolean(status?.ended);
  if (link === 'refused') {
    showBanner('Link lost: the token is not valid any more. Open the address that disflow_track printed.');
  } else if (!open) {
    showBanner('Link lost: what is shown is old. Trying again …');
  } else if (status?.ended) {
    showBanner('The input has ended.', 'quiet');
  } else {
    showBanner(status?.paused ? 'Paused.' : null, 'quiet');
  }
}

byId('pause').onclick = () => connection.send(objects[chosen]?.status?.paused ? 'resume' : 'pause', chosen);
byId('reset').onclick = () => connection.send('reset', chosen);
const pointing = pointAt(byId('depth'), byId('rubber'), {
  isWanted: () => 'choosing' in document.body.dataset,
  chosen: (place) => {
    connection.choose(chosen, place);
    setChoosing(false);
  },
});
function setChoosing(choosing) {
  document.body.toggleAttribute('data-choosing', choosing);
  byId('choose').ariaPressed = String(choosing);
  byId('choose-hint').hidden = !choosing;
  if (choosing) byId('depth').scrollIntoView({ block: 'nearest' });
  else pointing.stop();
}
byId('choose').onclick = () => setChoosing(!('choosing' in document.body.dataset));
addEventListener('keydown', (event) => {
  if (event.key === 'Escape') setChoosing(false);
});
byId('save').onclick = () => {
  const { surface, frames } = objects[chosen];
  const name = names.objects[chosen].replace(/[^\w-]/g, '_');
  download(plyOf(surface), `${name}-frame-${frames.at(-1)?.frame ?? 0}.ply`);
};
byId('home').onclick = () => scene.home();

const switches = { flow: 'show-flow', trail: 'show-trail', axes: 'show-axes', follow: 'follow' };
const showChosen = () =>
  scene.show(Object.fromEntries(Object.entries(switches).map(([name, id]) => [name, byId(id).checked])));
for (const id of Object.values(switches)) byId(id).onchange = showChosen;
showChosen();

const ramp = byId('ramp').getContext('2d');
for (let x = 0; x < 128; x += 1) {
  ramp.fillStyle = `rgb(${mapColour(x / 127).map(Math.round).join()})`;
  ramp.fillRect(x, 0, 1, 1);
}
showLink();
