// SPDX-License-Identifier: BSD-3-Clause
import uPlot from 'uplot';
import { cssColour, lineColours, onThemeChange } from './theme.js';

const kWindow_s = 30;
const kDegrees = 180 / Math.PI;
const norm = (values) => Math.hypot(...values);
// What a refused frame does not have is a gap in the plot.
const orGap = (value) => (Number.isFinite(value) ? value : null);
const number = (digits) => (_, value) => (Number.isFinite(value) ? value.toFixed(digits) : '–');

/** What is drawn of a frame: each line has a name and takes its value from the frame. */
function plansFor(stages) {
  return [
    { title: 'Speed', scales: ['m/s', '°/s'], lines: [
      { label: 'm/s', of: (f) => norm(f.linear), digits: 3, scale: 'm/s' },
      { label: '°/s', of: (f) => norm(f.angular) * kDegrees, digits: 1, scale: '°/s' }] },
    { title: 'Quality', scales: ['%'], range: [0, 100], lines: [
      { label: 'quality', of: (f) => f.quality, digits: 0, scale: '%' },
      { label: 'score', of: (f) => 100 * f.score, digits: 0, scale: '%' }] },
    { title: 'Standard deviation of the pose', scales: ['mm', '°'], lines: [
      { label: 'position, mm', of: (f) => 1000 * norm(f.poseStd.slice(0, 3)), digits: 2, scale: 'mm' },
      { label: 'rotation, °', of: (f) => norm(f.poseStd.slice(3)) * kDegrees, digits: 2, scale: '°' }] },
    { title: 'Milliseconds per stage', scales: ['ms'], stacked: true, lines:
      stages.map((label, i) => ({ label, of: (f) => f.stages[i], digits: 1, scale: 'ms' })) },
  ];
}

export class Plots {
  constructor(parent) {
    this.parent = parent;
    this.plots = [];
    this.clear();
    onThemeChange(() => this.#build());
    new ResizeObserver(() => this.#resize()).observe(parent);
  }

  setStages(stages) {
    this.stages = stages;
    this.#build();
  }

  clear() {
    this.frames = [];
    this.base = undefined;
    this.#update();
  }

  add(frames) {
    this.frames.push(...frames);
    const oldest = this.frames.at(-1).stamp - kWindow_s;
    const begin = this.frames.findIndex((frame) => frame.stamp >= oldest);
    if (begin > 0) this.frames.splice(0, begin);
    this.#update();
  }

  #build() {
    for (const { plot, box } of this.plots) {
      plot.destroy();
      box.remove();
    }
    this.plots = plansFor(this.stages ?? []).filter((plan) => plan.lines.length > 0).map((plan) => this.#buildOne(plan));
    this.#resize();
    this.#update();
  }

  #buildOne(plan) {
    const box = document.createElement('div');
    box.className = 'plot';
    const title = document.createElement('h2');
    title.textContent = plan.title;
    box.append(title);
    this.parent.append(box);
    const text = cssColour('--quiet');
    const grid = { stroke: cssColour('--line'), width: 1 };
    const font = '12px system-ui, sans-serif';
    const axis = { stroke: text, grid, ticks: grid, font, labelFont: font };
    const entry = { plan, box };
    entry.plot = new uPlot({
      width: 300, height: 120, cursor: { drag: { x: false, y: false } },
      scales: { x: { time: false, range: (_, low, high) => [Math.max(low ?? 0, high - kWindow_s), Math.max(high, (low ?? 0) + 1)] },
        ...Object.fromEntries(plan.scales.map((scale) => [scale, { range: plan.range ?? ((_, low, high) => [0, Math.max(1.1 * high, 1e-3)]) }])) },
      axes: [
        { ...axis, size: 26, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
        ...plan.scales.map((scale, i) => ({ ...axis, scale, side: i === 0 ? 3 : 1, size: 46, grid: i === 0 ? grid : { show: false } })),
      ],
      series: [{ label: 's', value: number(1) }, ...plan.lines.map((line, i) => this.#seriesOf(entry, line, i))],
    }, [[], ...plan.lines.map(() => [])], box);
    return entry;
  }

  #seriesOf(entry, line, i) {
    const colour = lineColours()[i % 6];
    const { plan } = entry;
    // A stack's lines are sums: the legend shows the parts.
    const value = (plot, shown, series, index) =>
      number(line.digits)(plot, index == null ? this.frames.at(-1) && line.of(this.frames.at(-1)) : line.of(this.frames[index]));
    return { label: line.label, scale: line.scale, stroke: colour, width: 1.5, value, points: { show: false }, fill: plan.stacked ? `${colour}66` : undefined };
  }

  #update() {
    for (const { plan, plot } of this.plots) {
      this.base ??= this.frames[0]?.stamp;
      const columns = [this.frames.map((frame) => frame.stamp - this.base)];
      plan.lines.forEach((line, i) => {
        columns.push(this.frames.map((frame, k) => orGap(line.of(frame) + (plan.stacked && i > 0 ? columns[i][k] : 0))));
      });
      plot.setData(columns);
    }
  }

  #resize() {
    const width = this.parent.clientWidth - 24;
    if (width > 50) for (const { plot } of this.plots) plot.setSize({ width, height: 120 });
  }
}
