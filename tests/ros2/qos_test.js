// SPDX-License-Identifier: BSD-3-Clause
// Whatever writers offer, they are heard, each message once; what is kept for those who come later, too. Usage: node qos_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { join } from "node:path";
import { before, test } from "node:test";
import { ballPlayer, maskMessage, message, stamps, transformMessage } from "./ball.js";
import { Peer } from "./peer.js";
import { repeat } from "./player.js";
import { atEnd, domain, file, ownBin, until } from "./program.js";
import { trajectory } from "./trajectory.js";

const network = `domain=${domain}&interface=lo&peer=127.0.0.1`;
const sensorOf = (name) => `dds:depth=/${name}/depth/image_rect_raw&name=${name}&${network}`;
let peer;
before(async () => (peer = await Peer.start(join(ownBin, "ros2_peer"), domain)));
atEnd(() => peer.stop());

async function unpublish(...topics) {
  for (const topic of topics) assert.equal(await peer.do("unpublish", "rt" + topic), "unpublished", topic);
}

for (const qos of ["reliable", "latched", "best_effort", "best_effort_latched"]) {
  test(`Depth, camera info, masks, /tf and /tf_static of ${qos} writers are all heard, each message once`, async () => {
    const player = ballPlayer(peer, qos, qos);
    await player.start("--sensor", sensorOf(qos), "--headless", "--csv", file(`${qos}.csv`),
      "--link", `dds:domain=${domain}&world=map&camera=eye&mask=/${qos}/mask`);
    // Topics of the link are there with the first frame.
    const sent = stamps.length - 1;
    player.sendImage = async (i) => {
      await player.publish("/tf_static", "tf2_msgs/TFMessage", qos, transformMessage(i, "gripper", "eye"));
      await player.publish("/tf", "tf2_msgs/TFMessage", qos, transformMessage(i, "map", "gripper"));
      await player.publish(`/${qos}/mask`, "sensor_msgs/Image", qos, maskMessage(i));
      await player.send(message(i));
    };
    for (let i = 1; i <= sent; ++i) await player.step(i);
    const { status, said } = await player.stop();
    await unpublish("/tf", "/tf_static");
    assert.equal(status, 0, said);
    assert.match(said, /camera poses: [1-9]\d+ received, .* [1-9]\d+ frames matched/, said);
    assert.match(said, new RegExp(`masks from /${qos}/mask: [1-9]\\d+ used`), said);
    const received = Number(/camera poses: (\d+) received/.exec(said)[1]);
    assert.ok(received <= 2 * sent, `two messages per image, each once: ${said}`);
    const good = trajectory(file(`${qos}.csv`)).filter((row) => row.status === "ok");
    assert.ok(good.length >= sent, said);
  });
}

test("A CameraInfo that was published once, before the tracker was there, is heard, and holds until its writer goes", async () => {
  const player = ballPlayer(peer, "once", "best_effort");
  await player.keepInfo(0);
  await player.run("--sensor", sensorOf("once"), "--headless", "--csv", file("once.csv"), "--link", `dds:domain=${domain}`);
  const count = async () => Number(await peer.do("count", player.status));
  const said = (words) => player.child.said().split(words).length - 1;
  let next = 0;
  const trackMore = async () => {
    const before = await count();
    await repeat(() => player.sendImage(next++), async () => (await count()) >= before + 3);
    assert.ok((await count()) >= before + 3, player.child.said());
  };
  await trackMore();

  // Another node's, which stays while that of the images starts anew.
  await unpublish("/once/depth/image_rect_raw");
  await until(() => said("its publisher is gone") === 1);
  await trackMore();
  assert.equal(said("the sensor is back"), 1, player.child.said());

  // Both start anew, and there is another camera.
  await unpublish("/once/depth/image_rect_raw", player.infoTopic());
  await until(() => said("its publisher is gone") === 2);
  player.camera = { ...player.camera, cx: player.camera.cx - 4 };
  await player.keepInfo(next);
  await trackMore();
  const end = await player.stop();
  assert.equal(end.status, 0, end.said);
  assert.equal(said("the sensor is back"), 2, end.said);
  const good = trajectory(file("once.csv")).filter((row) => row.status === "ok");
  const x = (row) => Number(row.x);
  assert.ok(Math.abs(x(good[0])) < 0.01, "in the middle of the image");
  assert.ok(x(good.at(-1)) > 0.02, `by the new intrinsics, on its right: ${JSON.stringify(good.at(-1))}`);
});
