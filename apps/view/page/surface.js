// SPDX-License-Identifier: BSD-3-Clause
import * as THREE from 'three';
import { mapColour } from './theme.js';

/** One colour per vertex by its standard deviation, 0..255 each. */
export function coloursOf(surface) {
  const [low, high] = surface.range;
  const width = Math.max(high - low, 1e-9);
  const colours = new Uint8Array(3 * surface.std.length);
  surface.std.forEach((std, v) => colours.set(mapColour((std - low) / width), 3 * v));
  return colours;
}

export function geometryOf(surface) {
  const geometry = new THREE.BufferGeometry();
  const linear = new Float32Array(3 * surface.std.length);
  const colour = new THREE.Color();
  const bytes = coloursOf(surface);
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
