// SPDX-License-Identifier: BSD-3-Clause
// State and numbers as text.

const kDegrees = 180 / Math.PI;
const byId = (id) => document.getElementById(id);
const fixed = (values, digits) => values.map((value) => (Number.isFinite(value) ? value.toFixed(digits) : '–')).join('  ');

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function showFrame(frame, names, framesPerSecond) {
  const state = names.states[frame.state];
  const badge = byId('state');
  badge.dataset.state = state;
  setText(badge, state);
  const weak = names.weak[frame.weak];
  showValues({
    Frame: String(frame.frame),
    Status: names.statuses[frame.status],
    Quality: `${frame.quality} of 100`,
    'Frames per second': framesPerSecond.toFixed(1),
    'Time per frame': `${frame.total.toFixed(1)} ms`,
    'Position, m': fixed(frame.position, 3),
    'Velocity, m/s': fixed(frame.linear, 2),
    'Turn rate, °/s': fixed(frame.angular.map((value) => value * kDegrees), 0),
    'Samples, inliers': `${frame.samples}, ${frame.inliers} + ${frame.edgeInliers} edge`,
    'Residual, rms': `${(1000 * frame.rms).toFixed(2)} mm`,
    'Weak direction': weak,
    Restarts: String(frame.resetCounter),
  });
}

function showValues(values) {
  const list = byId('values');
  for (const [name, value] of Object.entries(values)) {
    let item = list.querySelector(`[data-name="${name}"]`);
    if (!item) {
      const box = document.createElement('div');
      box.innerHTML = '<dt></dt><dd></dd>';
      [box.firstChild.textContent, item] = [name, box.lastChild];
      item.dataset.name = name;
      list.append(box);
    }
    setText(item, value);
  }
}

export function showCounters(status) {
  fill(byId('tracker-counters'), status.tracker);
  fill(byId('sensor-counters'), { ...status.sensor, 'frames not shown here': status.not_shown });
}

function fill(table, counters) {
  for (const [name, value] of Object.entries(counters)) {
    let row = [...table.rows].find((candidate) => candidate.cells[0].textContent === name);
    if (!row) {
      row = table.insertRow();
      row.insertCell().textContent = name;
      row.insertCell();
    }
    setText(row.cells[1], value.toLocaleString('en'));
  }
}

/** @param kind 'alarm' or 'quiet' */
export function showBanner(text, kind = 'alarm') {
  const banner = byId('banner');
  banner.hidden = !text;
  banner.dataset.kind = kind;
  setText(banner, text ?? '');
}

export function showRange(surface) {
  const millimetres = (value) => `${(1000 * value).toFixed(2)} mm`;
  setText(byId('ramp-low'), surface ? millimetres(surface.range[0]) : '');
  setText(byId('ramp-high'), surface ? millimetres(surface.range[1]) : '');
}
