// SPDX-License-Identifier: BSD-3-Clause
import { coloursOf } from './surface.js';

const kVertexBytes = 31;
const kFaceBytes = 13;

/** A surface as binary PLY, with the fields of the files that disflow_track writes. */
export function plyOf(surface) {
  const vertices = surface.std.length;
  const faces = surface.indices.length / 3;
  const header = new TextEncoder().encode(
    `ply\nformat binary_little_endian 1.0\n` +
    `comment object frame, metres; colours: std_m from ${surface.range[0]} (dark) to ${surface.range[1]} (bright)\n` +
    `element vertex ${vertices}\n` +
    ['x', 'y', 'z', 'nx', 'ny', 'nz'].map((name) => `property float ${name}\n`).join('') +
    ['red', 'green', 'blue'].map((name) => `property uchar ${name}\n`).join('') +
    `property float std_m\nelement face ${faces}\nproperty list uchar int vertex_indices\nend_header\n`);
  const bytes = new Uint8Array(header.length + vertices * kVertexBytes + faces * kFaceBytes);
  bytes.set(header);
  const view = new DataView(bytes.buffer);
  const colours = coloursOf(surface, 'linear');
  for (let v = 0, at = header.length; v < vertices; v += 1, at += kVertexBytes) {
    for (let i = 0; i < 3; i += 1) {
      view.setFloat32(at + 4 * i, surface.positions[3 * v + i], true);
      view.setFloat32(at + 12 + 4 * i, surface.normals[3 * v + i], true);
      view.setUint8(at + 24 + i, colours[3 * v + i]);
    }
    view.setFloat32(at + 27, surface.std[v], true);
  }
  for (let f = 0, at = header.length + vertices * kVertexBytes; f < faces; f += 1, at += kFaceBytes) {
    view.setUint8(at, 3);
    for (let i = 0; i < 3; i += 1) view.setInt32(at + 1 + 4 * i, surface.indices[3 * f + i], true);
  }
  return bytes;
}

export function download(bytes, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([bytes], { type: 'application/octet-stream' }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
