// SPDX-License-Identifier: BSD-3-Clause
// What the program takes from ROS 2. Usage: node inputs_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { decode, writerOf } from "./messages.js";
import { Peer } from "./peer.js";
import { ddsType, domain, file, ownBin, patience, run, samplesOf, sleep } from "./program.js";

const now = () => {
  const ms = Date.now();
  return { sec: Math.floor(ms / 1000), nsec: (ms % 1000) * 1000000 };
};
const transform = (parent, child, [x, y, z], [qx, qy, qz, qw]) => ({
  header: { stamp: now(), frame_id: parent },
  child_frame_id: child,
  transform: { translation: { x, y, z }, rotation: { x: qx, y: qy, z: qz, w: qw } },
});
const tf = writerOf("tf2_msgs/TFMessage");
const image = writerOf("sensor_msgs/Image");

async function publish(peer, topic, type, qos, bytes) {
  writeFileSync(file("sample"), bytes);
  assert.equal(await peer.do("publish", topic, ddsType(type), qos, file("sample")), "published");
}

test("tf moves the camera, and a topic tells which pixels are the object's", async () => {
  const peer = await Peer.start(join(ownBin, "ros2_peer"), domain);
  const path = "rt/disflow/object/path";
  await peer.do("subscribe", path, ddsType("nav_msgs/Path"), "latched", file("path"));
  const child = run(
    // So slow that frames are there when their stamps say.
    "--sensor", `sim:box?motion=static&width=160&height=120&fps=${30 / patience}`, "--rate", "realtime", "--frames", "900", "--headless",
    "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1&world=map&camera=eye&mask=/segmenter/mask`,
  );
  const quarter = Math.SQRT1_2;
  const fixed = { transforms: [transform("gripper", "eye", [0, 0, 0.1], [0, 0, quarter, quarter])] };
  await publish(peer, "rt/tf_static", "tf2_msgs/TFMessage", "latched", tf.writeMessage(fixed));
  const mask = { height: 120, width: 160, encoding: "mono8", is_bigendian: 0, step: 160 };
  for (let i = 0; i < 80 * patience; ++i) {
    const moving = { transforms: [transform("map", "gripper", [1, 2, 3], [0, 0, 0, 1]), transform("x", "y", [0, 0, 0], [0, 0, 0, 0])] };
    await publish(peer, "rt/tf", "tf2_msgs/TFMessage", "reliable", tf.writeMessage(moving));
    const header = { stamp: now(), frame_id: "eye" };
    const data = new Uint8Array(160 * 120).fill(255);
    await publish(peer, "rt/segmenter/mask", "sensor_msgs/Image", "best_effort", image.writeMessage({ header, ...mask, data }));
    await sleep(20);
  }
  const short = { header: { stamp: now(), frame_id: "eye" }, ...mask, height: 60000, data: new Uint8Array(10) };
  await publish(peer, "rt/segmenter/mask", "sensor_msgs/Image", "best_effort", image.writeMessage(short));
  await sleep(100 * patience);
  child.kill("SIGTERM");
  const { status, said } = await child.ended;
  await samplesOf(peer, path, 1);
  await peer.stop();
  assert.equal(status, 0, said);
  assert.match(said, /masks from \/segmenter\/mask: [1-9]\d+ used/, said);
  assert.match(said, /camera poses: [1-9]\d+ received, .* [1-9]\d+ frames matched/, said);
  const paths = decode(file("path"), "nav_msgs/Path").filter(({ header }) => header.frame_id === "map");
  assert.ok(paths.length > 0, "a path in the world");
  // The box is in front of the camera, which looks up (z) from (1, 2, 3.1).
  const { position } = paths[0].poses[0].pose;
  assert.ok(position.z > 3.3 && Math.abs(position.x - 1) < 0.3 && Math.abs(position.y - 2) < 0.3, JSON.stringify(position));
});
