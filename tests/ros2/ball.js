// SPDX-License-Identifier: BSD-3-Clause
// A ball in front of a wall, with all that a camera of ROS 2 and what stands beside it tell of it.
import { rows } from "./frames.js";
import { writerOf } from "./messages.js";
import { headerOf, Player } from "./player.js";

const camera = { width: 80, height: 60, fx: 80, fy: 80, cx: 40, cy: 30 };
export const stamps = Array.from({ length: 40 }, (_, i) => 1789012345000000000n + BigInt(i) * 33333333n);
const image = writerOf("sensor_msgs/Image");
const tf = writerOf("tf2_msgs/TFMessage");

/** No two images of it are the same. */
function ball(i) {
  const values = new Uint16Array(80 * 60).map((_, k) => {
    const [u, v] = [(k % 80) - 40, Math.floor(k / 80) - 30];
    const inside = 20 * 20 - u * u - v * v;
    return inside > 0 ? 900 - 10 * Math.sqrt(inside) + ((k * (i + 7)) % 3) : 2000;
  });
  return rows({ width: 80, height: 60 }, values, 160, false);
}
export const message = (i, change = {}) =>
  image.writeMessage({
    header: headerOf(stamps[i]), height: 60, width: 80, encoding: "16UC1", is_bigendian: 0, step: 160, data: ball(i), ...change,
  });

export function maskMessage(i) {
  const data = new Uint8Array(80 * 60).map((_, k) => ((k % 80) - 40) ** 2 + (Math.floor(k / 80) - 30) ** 2 < 400 ? 1 : 0);
  return image.writeMessage({ header: headerOf(stamps[i]), height: 60, width: 80, encoding: "mono8", is_bigendian: 0, step: 80, data });
}

export function transformMessage(i, parent, child) {
  const transform = { translation: { x: 1, y: 2, z: 3 }, rotation: { x: 0, y: 0, z: 0, w: 1 } };
  return tf.writeMessage({ transforms: [{ header: { ...headerOf(stamps[i]), frame_id: parent }, child_frame_id: child, transform }] });
}

export function ballPlayer(peer, name, qos) {
  const player = new Player({ peer, camera, name, qos, stamps });
  player.send = (bytes) => player.publish(`/${name}/depth/image_rect_raw`, "sensor_msgs/Image", qos, bytes);
  player.sendImage = (i) => player.send(message(i));
  player.sendRubbish = () => player.send(message(0, { width: 0, height: 0, data: new Uint8Array() }));
  return player;
}
