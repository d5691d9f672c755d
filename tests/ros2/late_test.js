// SPDX-License-Identifier: BSD-3-Clause
// Who comes late, and who is refused. Usage: node late_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { decode, graphEntry, writerOf } from "./messages.js";
import { Peer } from "./peer.js";
import { ddsType, domain, file, ownBin, patience, run, samplesOf, sleep } from "./program.js";
import { trajectory } from "./trajectory.js";

const requestHeader = "uint64 client\nint64 seq\n";
const reset = {
  request: requestHeader + "uint8 structure_needs_at_least_one_member",
  response: requestHeader + "bool success\nstring message",
};
test("Who comes late sees the node, the path and the surface, and can reset the object", async () => {
  const child = run(
    "--sensor", "sim:box?motion=moderate", "--rate", "realtime", "--frames", "900", "--headless", "--csv", file("late.csv"),
    "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1&name=robot&camera=d415_optical&reset=yes`,
  );
  await sleep(1500 * patience);
  const peer = await Peer.start(join(ownBin, "ros2_peer"), domain);
  const seen = async (topic, type, name) => {
    await peer.do("subscribe", topic, type, "latched", file(name));
    await samplesOf(peer, topic, 1);
  };
  await seen("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", "graph");
  await seen("rt/robot/object/path", ddsType("nav_msgs/Path"), "late_path");
  await seen("rt/robot/object/surface", ddsType("visualization_msgs/Marker"), "late_surface");
  const header = { client: 1n, seq: 2n };
  writeFileSync(file("request"), writerOf(reset.request).writeMessage({ ...header, structure_needs_at_least_one_member: 0 }));
  const answer = await peer.do(
    "call", "rq/robot/object/resetRequest", "std_srvs::srv::dds_::Trigger_Request_",
    "rr/robot/object/resetReply", "std_srvs::srv::dds_::Trigger_Response_", file("request"), file("reset"),
  );
  await sleep(300 * patience);
  child.kill("SIGTERM");
  const { status, said } = await child.ended;
  await peer.stop();
  assert.equal(status, 0, said);
  assert.equal(answer, "answered");
  const [reply] = decode(file("reset"), reset.response);
  assert.deepEqual({ client: reply.client, seq: reply.seq, success: reply.success }, { ...header, success: true });
  const run2 = trajectory(file("late.csv"));
  assert.equal(run2[0].reset_counter, "0");
  assert.equal(run2.at(-1).reset_counter, "1");

  const [{ gid, node_entities_info_seq: nodes }] = decode(file("graph"), graphEntry);
  assert.deepEqual(nodes.map((node) => node.node_namespace + node.node_name), ["/robot"]);
  assert.equal(nodes[0].reader_gid_seq.length, 2, "two services");
  assert.equal(nodes[0].writer_gid_seq.length, 11, "nine topics and two services");
  for (const entity of [...nodes[0].reader_gid_seq, ...nodes[0].writer_gid_seq]) {
    assert.deepEqual(entity.data.slice(0, 12), gid.data.slice(0, 12), "of this participant");
  }
  assert.equal(decode(file("late_path"), "nav_msgs/Path")[0].header.frame_id, "d415_optical");
  assert.equal(decode(file("late_surface"), "visualization_msgs/Marker")[0].header.frame_id, "robot/object");
});

test("Without reset=yes nobody on the network is offered to reset the object", async () => {
  const child = run(
    "--sensor", "sim:box?motion=moderate", "--rate", "realtime", "--frames", "900", "--headless",
    "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1&name=deaf`,
  );
  const peer = await Peer.start(join(ownBin, "ros2_peer"), domain);
  await peer.do("subscribe", "ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", "latched", file("deaf"));
  await samplesOf(peer, "ros_discovery_info", 1);
  child.kill("SIGTERM");
  const { status, said } = await child.ended;
  await peer.stop();
  assert.equal(status, 0, said);
  const [{ node_entities_info_seq: nodes }] = decode(file("deaf"), graphEntry);
  assert.deepEqual(nodes.map((node) => node.node_name), ["deaf"]);
  assert.equal(nodes[0].reader_gid_seq.length, 1, "the query of the distance field alone");
  assert.equal(nodes[0].writer_gid_seq.length, 10, "nine topics and one service");
});

for (const [address, message] of [
  ["dds:domain=233", /not a number from 0 to 232/],
  ["dds:domain=0&domain=1", /given twice/],
  ["dds:speed=1", /unknown option speed/],
  ["dds:domain=0&interface=nothere9", /nothere9/],
]) {
  test(`'${address}' is refused with words that help`, async () => {
    const { status, said } = await run("--sensor", "sim:box", "--frames", "1", "--link", address).ended;
    assert.ok(status === 2 || status === 4);
    assert.match(said, message);
  });
}
