// SPDX-License-Identifier: BSD-3-Clause
// Depth images as messages, of every kind that is understood: each encodes a frame with its stamp.
import { millimetres, png, rows } from "./frames.js";
import { writerOf } from "./messages.js";
import { headerOf } from "./player.js";

const image = writerOf("sensor_msgs/Image");
const compressed = writerOf("sensor_msgs/CompressedImage");

export const raw = (encoding, values, { padding = 0, bigEndian = false } = {}) => ({
  type: "sensor_msgs/Image",
  encode: (frame, stamp) => {
    const data = values(frame);
    const step = frame.width * data.BYTES_PER_ELEMENT + padding;
    return image.writeMessage({
      header: headerOf(stamp), height: frame.height, width: frame.width, encoding, is_bigendian: bigEndian ? 1 : 0, step,
      data: rows(frame, data, step, bigEndian),
    });
  },
});
export const metres = ({ metres }) => metres;
export const packed = (format, data) => ({
  type: "sensor_msgs/CompressedImage",
  encode: (frame, stamp) => compressed.writeMessage({ header: headerOf(stamp), format, data: data(frame) }),
});
export const packedMillimetres = (frame) => {
  const values = frame.width > 0 ? millimetres(frame) : new Uint16Array();
  return new Uint8Array(Buffer.concat([Buffer.alloc(12), png(frame.width, frame.height, values)]));
};
