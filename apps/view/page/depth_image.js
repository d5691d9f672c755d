// SPDX-License-Identifier: BSD-3-Clause

const kMask = [255, 140, 40];
const kMaskShare = 0.3;

/** Draws near pixels bright, pixels without depth black, the object's tinted and outlined. */
export function drawDepth(canvas, depth) {
  canvas.width = depth.width;
  canvas.height = depth.height;
  canvas.style.aspectRatio = `${depth.width} / ${depth.height}`;
  const context = canvas.getContext('2d');
  const image = context.createImageData(depth.width, depth.height);
  const marked = (i) => (depth.mask[i >> 3] >> (i & 7)) & 1;
  for (let i = 0; i < depth.levels.length; i += 1) {
    const level = depth.levels[i] === 0 ? 0 : 250 - 0.8 * depth.levels[i];
    const inside = marked(i - 1) && marked(i + 1) && marked(i - depth.width) && marked(i + depth.width);
    const share = marked(i) ? (inside ? kMaskShare : 1) : 0;
    for (let c = 0; c < 3; c += 1) image.data[4 * i + c] = (1 - share) * level + share * kMask[c];
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}
