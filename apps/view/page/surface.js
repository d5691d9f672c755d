// SPDX-License-Identifier: BSD-3-Clause
import * as THREE from 'three';
import { mapColour } from './theme.js';

const kLeast = 1e-6; // m

/** From 0 (certain) to 1; on the screen by the logarithm, or a few bad rims would hide all else. */
const share = {
  linear: (std, [low, high]) => (std - low) / Math.max(high - low, kLeast),
  logarithmic: (std, [low, high]) =>
    Math.log(Math.max(std, kLeast) / Math.max(low, kLeast)) / Math.max(Math.log(high / Math.max(low, kLeast)), 1e-3),
};

/** One colour per vertex by its standard deviation, 0..255 each. */
export function coloursOf(surface, scale) {
  const colours = new Uint8Array(3 * surface.std.length);
  surface.std.forEach((std, v) => colours.set(mapColour(share[scale](std, surface.range)), 3 * v));
  return colours;
}

export function geometryOf(surface) {
  const geometry = new THREE.BufferGeometry();
  const linear = new Float32Array(3 * surface.std.length);
  const colour = new THREE.Color();
  const bytes = coloursOf(surface, 'logarithmic');
  for (let i = 0; i < linear.length; i += 3) {
    colour.setRGB(bytes[i] / 255, bytes[i + 1] / 255, bytes[i + 2] / 255, THREE.SRGBColorSpace);
    colour.toArray(linear, i);
  }
  geometry.setAttribute('position', new THREE.BufferAttribute(surface.positions, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(surface.normals, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(linear, 3));
  geometry.setIndex(new THREE.BufferAttribute(surface.indices, 1));
  return geometry;
}
