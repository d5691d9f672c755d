// SPDX-License-Identifier: BSD-3-Clause
// What ros2 run and launch files hand to a program: names and topics are others then. Usage: node ros_args_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { join } from "node:path";
import { before, test } from "node:test";
import { ballPlayer, maskMessage, message } from "./ball.js";
import { caller } from "./calls.js";
import { decode, graphEntry } from "./messages.js";
import { Peer } from "./peer.js";
import { atEnd, domain, file, ownBin } from "./program.js";

let peer;
before(async () => (peer = await Peer.start(join(ownBin, "ros2_peer"), domain)));
atEnd(() => peer.stop());

test("Remapped topics are read, and all that is the node's is in its namespace", async () => {
  await peer.do("subscribe", "ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", "latched", file("graph"));
  const player = ballPlayer(peer, "robot1/eye", "reliable");
  const network = `domain=${domain}&interface=lo&peer=127.0.0.1`;
  await player.start(
    "--headless", "--sensor", `dds:${network}`, "--link", `dds:${network}&mask=/nobody&parameters=yes&lifecycle=yes&reset=yes`,
    "--ros-args", "-r", "__node:=eye", "-r", "__ns:=/robot1", "-r", "depth:=~/depth/image_rect_raw", "-r", "mask:=segmenter/mask",
    "-p", "registration.iterations:=13");
  player.sendImage = async (i) => {
    await player.publish("/robot1/segmenter/mask", "sensor_msgs/Image", "reliable", maskMessage(i));
    await player.send(message(i));
  };
  for (let i = 1; i < 10; ++i) await player.step(i);

  const call = caller(peer, "robot1/eye");
  const names = ["object.registration.iterations"];
  const { values } = await call("rcl_interfaces/GetParameters", "get_parameters", { names });
  assert.equal(values[0].integer_value, 13n);
  const { current_state: state } = await call("lifecycle_msgs/GetState", "get_state", { structure_needs_at_least_one_member: 0 });
  assert.equal(state.label, "active");

  const { status, said } = await player.stop();
  assert.equal(status, 0, said);
  assert.match(said, /masks from \/robot1\/segmenter\/mask: [1-9]\d* used/, said);
  const { node_entities_info_seq: nodes } = decode(file("graph"), graphEntry).at(-1);
  assert.deepEqual(nodes.map((node) => [node.node_namespace, node.node_name]), [["/robot1", "eye"]]);
});
