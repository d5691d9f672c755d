// SPDX-License-Identifier: BSD-3-Clause
// The server's messages, byte by byte as docs/view.md says.

const Kind = { hello: 1, status: 2, frames: 3, surface: 4, flow: 5, depth: 6, settings: 7 };
const Command = { reset: 1, pause: 2, resume: 3, choose: 4, set: 5 };

const kFlowUnit = 0.00025; // m and m/s
const kWord = 65535;

/** The bytes of a request, e.g. encodeCommand('reset', 0). */
export function encodeCommand(name, object) {
  return new Uint8Array([Command[name], object, 0, 0]);
}

/**
 * The bytes of "track this instead".
 * @param {{u, v, reach, width, height}} place Shares of the picture; without width and height a place, else a box.
 */
export function encodeChoice(object, { u, v, reach = 0, width = 0, height = 0 }) {
  const view = new DataView(new ArrayBuffer(14));
  view.setUint8(0, Command.choose);
  view.setUint8(1, object);
  const share = (value) => Math.round(Math.min(Math.max(value, 0), 1) * kWord);
  [u, v, reach, width, height].forEach((value, i) => view.setUint16(4 + 2 * i, share(value), true));
  return new Uint8Array(view.buffer);
}

/** The bytes of "this setting shall have this value". */
export function encodeSetting(object, number, value) {
  const view = new DataView(new ArrayBuffer(14));
  view.setUint8(0, Command.set);
  view.setUint8(1, object);
  view.setUint16(2, number, true);
  view.setFloat64(4, value, true);
  return new Uint8Array(view.buffer);
}

/** Gives {kind, object, ...} or null for a kind that this page does not know. */
export function decode(buffer) {
  const view = new DataView(buffer);
  const head = { object: view.getUint8(1), detail: view.getUint16(2, true), count: view.getUint32(4, true) };
  switch (view.getUint8(0)) {
    case Kind.hello: return { kind: 'hello', ...decodeText(buffer) };
    case Kind.status: return { kind: 'status', object: head.object, ...decodeText(buffer) };
    case Kind.frames: return { kind: 'frames', object: head.object, frames: decodeFrames(view, head) };
    case Kind.surface: return { kind: 'surface', object: head.object, ...decodeSurface(buffer, view, head) };
    case Kind.flow: return { kind: 'flow', object: head.object, ...decodeFlow(view, head) };
    case Kind.depth: return { kind: 'depth', object: head.object, ...decodeDepth(buffer, view, head) };
    case Kind.settings: return { kind: 'settings', object: head.object, ...decodeText(buffer) };
    default: return null;
  }
}

function decodeText(buffer) {
  return JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8)));
}

function decodeFrames(view, head) {
  const frames = [];
  for (let i = 0; i < head.count; i += 1) frames.push(decodeFrame(view, 8 + i * head.detail));
  return frames;
}

function decodeFrame(view, at) {
  const floats = (offset, count) =>
    Array.from({ length: count }, (_, i) => view.getFloat32(at + offset + 4 * i, true));
  const [w, x, y, z] = floats(28, 4);
  return {
    stamp: view.getFloat64(at, true),
    frame: view.getUint32(at + 8, true),
    state: view.getUint8(at + 12),
    status: view.getUint8(at + 13),
    quality: view.getUint8(at + 14),
    resetCounter: view.getUint8(at + 15),
    position: floats(16, 3),
    rotation: [x, y, z, w],
    linear: floats(44, 3),
    angular: floats(56, 3),
    poseStd: floats(68, 6),
    twistStd: floats(92, 6),
    stages: floats(116, 6),
    total: view.getFloat32(at + 140, true),
    samples: view.getUint16(at + 144, true),
    inliers: view.getUint16(at + 146, true),
    edgeInliers: view.getUint16(at + 148, true),
    weak: view.getUint8(at + 150),
    iterations: view.getUint8(at + 151),
    score: view.getFloat32(at + 152, true),
    rms: view.getFloat32(at + 156, true),
  };
}

function decodeSurface(buffer, view, head) {
  const vertices = head.count;
  const triangles = view.getUint32(8, true);
  const largest = view.getFloat32(20, true);
  const low = [0, 1, 2].map((i) => view.getFloat32(32 + 4 * i, true));
  const size = [0, 1, 2].map((i) => view.getFloat32(44 + 4 * i, true));
  const words = new Uint16Array(buffer, 56, 4 * vertices);
  const packed = new Int8Array(buffer, 56 + 8 * vertices, 4 * vertices);
  const positions = new Float32Array(3 * vertices);
  const normals = new Float32Array(3 * vertices);
  const std = new Float32Array(vertices);
  for (let v = 0; v < vertices; v += 1) {
    for (let i = 0; i < 3; i += 1) {
      positions[3 * v + i] = low[i] + (words[4 * v + i] / kWord) * size[i];
      normals[3 * v + i] = packed[4 * v + i] / 127;
    }
    std[v] = (words[4 * v + 3] / kWord) * largest;
  }
  const Index = head.detail === 2 ? Uint16Array : Uint32Array;
  return {
    stamp: view.getFloat64(24, true), range: [view.getFloat32(12, true), view.getFloat32(16, true)],
    low, size, positions, normals, std, indices: new Index(buffer, 56 + 12 * vertices, 3 * triangles),
  };
}

function decodeFlow(view, head) {
  const positions = new Float32Array(3 * head.count);
  const flows = new Float32Array(3 * head.count);
  for (let s = 0; s < head.count; s += 1) {
    const at = 16 + s * head.detail;
    for (let i = 0; i < 3; i += 1) {
      positions[3 * s + i] = view.getInt16(at + 2 * i, true) * kFlowUnit;
      flows[3 * s + i] = view.getInt16(at + 6 + 2 * i, true) * kFlowUnit;
    }
  }
  return { stamp: view.getFloat64(8, true), positions, flows };
}

function decodeDepth(buffer, view, head) {
  const pixels = head.detail * head.count;
  return {
    width: head.detail, height: head.count,
    near: view.getUint16(8, true) / 1000, far: view.getUint16(10, true) / 1000,
    levels: new Uint8Array(buffer, 12, pixels), mask: new Uint8Array(buffer, 12 + pixels),
  };
}
