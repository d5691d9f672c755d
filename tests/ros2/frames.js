// SPDX-License-Identifier: BSD-3-Clause
// Depth images as ROS 2 drivers send them, and as replay: reads them.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";

/** The images of a recording, in metres. */
export function readFrames(folder, count) {
  return Array.from({ length: count }, (_, i) => {
    const bytes = readFileSync(join(folder, "depth", `${i}.float`));
    const [width, height] = [Number(bytes.readBigUInt64LE(0)), Number(bytes.readBigUInt64LE(8))];
    const metres = new Float32Array(width * height);
    for (let k = 0; k < metres.length; ++k) metres[k] = bytes.readFloatLE(16 + 4 * k);
    return { width, height, metres };
  });
}

const seconds = (ns) => `${ns / 1000000000n}.${String(ns % 1000000000n).padStart(9, "0")}`;
/** A data.txt. */
export const stampLines = (stamps) => stamps.map((ns, i) => `${i} ${seconds(ns)}\n`).join("");

/** A recording with other stamps (nanoseconds) or other images. */
export function writeRecording(folder, camera, stamps, frames) {
  mkdirSync(join(folder, "depth"), { recursive: true });
  writeFileSync(join(folder, "cam_K.json"), JSON.stringify(camera));
  writeFileSync(join(folder, "data.txt"), stampLines(stamps));
  frames.forEach(({ width, height, metres }, i) => {
    const head = Buffer.alloc(16);
    head.writeBigUInt64LE(BigInt(width), 0);
    head.writeBigUInt64LE(BigInt(height), 8);
    writeFileSync(join(folder, "depth", `${i}.float`), Buffer.concat([head, new Uint8Array(metres.buffer)]));
  });
}

export const millimetres = ({ metres }) => Uint16Array.from(metres, (z) => Math.round(1000 * z));

/** node:zlib has one from Node 22 on. */
function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** A grey PNG of 16 bits. */
export function png(width, height, values) {
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name), data]);
    const frame = Buffer.alloc(8);
    frame.writeUInt32BE(data.length, 0);
    frame.writeUInt32BE(crc32(body), 4);
    return Buffer.concat([frame.subarray(0, 4), body, frame.subarray(4)]);
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header[8] = 16;
  const rows = Buffer.alloc(height * (1 + 2 * width));
  values.forEach((value, i) => rows.writeUInt16BE(value, 2 * i + 1 + Math.floor(i / width)));
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  const chunks = [chunk("IHDR", header), chunk("IDAT", deflateSync(rows)), chunk("IEND", Buffer.alloc(0))];
  return Buffer.concat([signature, ...chunks]);
}

/** The data of a sensor_msgs/Image, its rows `step` bytes apart. */
export function rows({ width, height }, values, step, bigEndian) {
  const bytes = values.BYTES_PER_ELEMENT;
  const data = Buffer.alloc(height * step, 0xa5);
  values.forEach((value, i) => {
    const at = Math.floor(i / width) * step + (i % width) * bytes;
    if (bytes === 4) bigEndian ? data.writeFloatBE(value, at) : data.writeFloatLE(value, at);
    else bigEndian ? data.writeUInt16BE(value, at) : data.writeUInt16LE(value, at);
  });
  return new Uint8Array(data);
}

/** As compressed_depth_image_transport quantises metres: what is sent, and what comes out of it. */
export function quantised({ width, height, metres }) {
  const a = Math.fround(100 * 101);
  const b = Math.fround(1 - a / 10);
  const values = Uint16Array.from(metres, (z) => (z > 0 && z < 10 ? Math.fround(a / z + b) : 0));
  const back = Float32Array.from(values, (q) => (q === 0 ? 0 : a / Math.fround(q - b)));
  const head = Buffer.alloc(12);
  head.writeFloatLE(a, 4);
  head.writeFloatLE(b, 8);
  return {
    data: new Uint8Array(Buffer.concat([head, png(width, height, values)])),
    frame: { width, height, metres: back },
  };
}

/** A CameraInfo without distortion. */
export function cameraInfo(header, { width, height, fx, fy, cx, cy }) {
  return {
    header, width, height, distortion_model: "plumb_bob",
    d: new Float64Array(5),
    k: Float64Array.of(fx, 0, cx, 0, fy, cy, 0, 0, 1),
    r: Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1),
    p: Float64Array.of(fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0),
    binning_x: 0, binning_y: 0,
    roi: { x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false },
  };
}
