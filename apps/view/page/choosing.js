// SPDX-License-Identifier: BSD-3-Clause
// Pointing at what is to be tracked: a click in the depth image, or a box drawn there.

const kClick_px = 6; // A pointer that moved less was meant to stand still.
const kFinger_px = 24; // How far a finger, or a hand that follows a moving thing, may be off.

/**
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLElement} rubber The box while it is drawn, laid over the canvas.
 * @param {(place) => void} chosen Called with shares of the picture: {u, v, reach} or {u, v, width, height}.
 */
export function pointAt(canvas, rubber, { isWanted, chosen }) {
  let start = null;

  const at = (event) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const within = (value, size) => Math.min(Math.max(value, 0), size);
    return { x: within(event.clientX - left, width), y: within(event.clientY - top, height), width, height };
  };
  const boxTo = (end) => ({
    left: Math.min(start.x, end.x), top: Math.min(start.y, end.y),
    width: Math.abs(end.x - start.x), height: Math.abs(end.y - start.y),
  });
  const isClick = (box) => Math.max(box.width, box.height) < kClick_px;

  canvas.addEventListener('pointerdown', (event) => {
    if (!isWanted() || !event.isPrimary) return;
    start = at(event);
    canvas.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!start) return;
    const box = boxTo(at(event));
    rubber.hidden = isClick(box);
    for (const [name, value] of Object.entries(box)) rubber.style[name] = `${value}px`;
  });
  canvas.addEventListener('pointerup', (event) => {
    if (!start) return;
    const end = at(event);
    const box = boxTo(end);
    const began = start;
    stop();
    if (isClick(box)) {
      chosen({ u: began.x / end.width, v: began.y / end.height, reach: kFinger_px / end.width });
    } else {
      chosen({ u: box.left / end.width, v: box.top / end.height, width: box.width / end.width, height: box.height / end.height });
    }
  });
  const stop = () => {
    start = null;
    rubber.hidden = true;
  };
  canvas.addEventListener('pointercancel', stop);
  return { stop };
}
