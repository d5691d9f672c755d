// SPDX-License-Identifier: BSD-3-Clause
// Depth images from ROS 2 together with all else that ROS 2 has to say, and what goes wrong.
// Usage: node depth_faults_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { join } from "node:path";
import { before, test } from "node:test";
import { ballPlayer, maskMessage, message, stamps, transformMessage } from "./ball.js";
import { decode, graphEntry } from "./messages.js";
import { Peer } from "./peer.js";
import { headerOf, repeat } from "./player.js";
import { atEnd, domain, file, ownBin, run, samplesOf, sleep, until } from "./program.js";
import { trajectory } from "./trajectory.js";

const network = `domain=${domain}&interface=lo&peer=127.0.0.1`;
let peer;
before(async () => (peer = await Peer.start(join(ownBin, "ros2_peer"), domain)));
atEnd(() => peer.stop());

const playerOf = (name) => ballPlayer(peer, name, "reliable");
const sensorOf = (name) => `dds:depth=/${name}/depth/image_rect_raw&name=${name}&${network}`;

test("Depth, masks and tf come in and poses go out by one node", async () => {
  const player = playerOf("together");
  await peer.do("subscribe", "ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", "latched", file("graph"));
  player.sendImage = async (i) => {
    await player.publish("/tf", "tf2_msgs/TFMessage", "reliable", transformMessage(i, "map", "eye"));
    await player.publish("/together/mask", "sensor_msgs/Image", "best_effort", maskMessage(i));
    await player.send(message(i));
  };
  const start = ["--sensor", sensorOf("together"), "--headless", "--csv", file("together.csv")];
  // Topics of the link are there with the first frame, so tf and masks only reach it later.
  const sendAll = player.sendImage;
  player.sendImage = (i) => player.send(message(i));
  await player.start(...start, "--link", `dds:domain=${domain}&world=map&camera=eye&mask=/together/mask`);
  player.sendImage = sendAll;
  for (let i = 1; i < stamps.length; ++i) await player.step(i);
  const { status, said } = await player.stop();
  assert.equal(status, 0, said);
  assert.match(said, /masks from \/together\/mask: [1-9]\d+ used/, said);
  assert.match(said, /camera poses: [1-9]\d+ received, .* [1-9]\d+ frames matched/, said);
  const participants = decode(file("graph"), graphEntry);
  assert.equal(new Set(participants.map(({ gid }) => String(gid.data))).size, 1, "one participant");
  const { node_entities_info_seq: nodes } = participants.at(-1);
  assert.deepEqual(nodes.map((node) => node.node_namespace + node.node_name), ["/together"]);
  assert.equal(nodes[0].reader_gid_seq.length, 9, "depth, mask, one service, and two each of info, tf, tf_static");
  assert.equal(nodes[0].writer_gid_seq.length, 10, "nine topics and one service");
});

test("Messages that are of no use cost themselves alone, and are counted", async () => {
  const player = playerOf("rubbish");
  await player.start("--sensor", sensorOf("rubbish"), "--headless", "--csv", file("rubbish.csv"), "--link", `dds:domain=${domain}`);
  const wrong = [
    { width: 0xffffffff, height: 0xffffffff, step: 0xffffffff }, { width: 81 }, { step: 3 }, { data: new Uint8Array(7) },
    { encoding: "8UC3" }, { encoding: "" }, { encoding: "\u001b[2J".repeat(20000) }, { data: new Uint8Array(2000000), height: 59 },
    { header: { stamp: { sec: 0, nsec: 0 }, frame_id: "" } }, { header: { stamp: { sec: -5, nsec: 0 }, frame_id: "" } },
  ];
  let rows = 1;
  for (const [k, change] of wrong.entries()) {
    await player.send(message(k + 1, change));
    await samplesOf(peer, player.status, ++rows);
    await player.send(message(k + 1));
    await samplesOf(peer, player.status, ++rows);
  }
  for (let i = 0; i < 40; ++i) await player.send(Uint8Array.of(0, 1, 0, 0, 1, 2, 3)); // no message at all
  await player.send(message(wrong.length + 1));
  await samplesOf(peer, player.status, ++rows);
  const { status, said } = await player.stop();
  assert.equal(status, 0, said);
  // Which Cyclone DDS says, but not for ever.
  const complaints = said.split("deserialization").length - 1;
  assert.ok(complaints > 0 && complaints <= 20, said);
  assert.doesNotMatch(said.replaceAll("\n", ""), /[^ -~]/, "nothing that a terminal obeys");
  const seen = trajectory(file("rubbish.csv"));
  assert.equal(seen.length, rows);
  assert.equal(seen.filter((row) => /corrupt|truncated/.test(row.status)).length, wrong.length, said);
  assert.ok(seen.slice(-1)[0].status === "ok", JSON.stringify(seen.slice(-1)[0]));
});

test("A camera's clock that is set costs the frames that lie behind, is counted, and starts no object anew", async () => {
  const hour = 3600000000000n;
  const player = playerOf("set");
  // Set forwards, back, and forwards again.
  player.stamps = stamps.map((stamp, i) => (Math.floor(i / 10) % 2 === 1 ? stamp + hour : stamp));
  player.sendImage = (i) => player.send(message(i, { header: headerOf(player.stamps[i]) }));
  const { status, said } = await player.play(
    "--sensor", sensorOf("set"), "--headless", "--csv", file("set.csv"), "--link", `dds:domain=${domain}`);
  assert.equal(status, 0, said);
  assert.match(said, /\b10 stamp_not_increasing/, said);
  assert.match(said, /\b0 restarts/, said);
  const seen = trajectory(file("set.csv"));
  assert.equal(seen.length, stamps.length);
  assert.deepEqual(seen.flatMap((row, i) => (row.status === "stamp_not_increasing" ? [i] : [])), [20, 21, 22, 23, 24, 25, 26, 27, 28, 29]);
  assert.equal(new Set(seen.map((row) => row.reset_counter)).size, 1, "the object was not started anew");
  // The ball stands still; an hour of waiting must not make it fly.
  for (const row of seen.filter(({ vx }) => vx !== "" && vx !== "nan")) {
    assert.ok(Math.hypot(row.vx, row.vy, row.vz) < 0.5, JSON.stringify(row));
  }
  // To the tracker an hour forwards is an hour without images; a ball tells too little to be found again for sure.
  assert.notEqual(seen.at(-1).status, "stamp_not_increasing");
});

test("A driver that ends is waited for, and tracked on when it is back", async () => {
  const player = playerOf("restart");
  await player.start("--sensor", sensorOf("restart"), "--headless", "--csv", file("restart.csv"), "--link", `dds:domain=${domain}`);
  await player.step(1);
  for (const topic of ["image_rect_raw", "camera_info"]) {
    assert.equal(await peer.do("unpublish", `rt/restart/depth/${topic}`), "unpublished");
  }
  await until(() => /waiting for it to come back/.test(player.child.said()));
  assert.match(player.child.said(), /its publisher is gone; waiting for it to come back/);
  const refused = () => player.child.said().split("0 x 0 pixels").length - 1;
  const before = refused();
  await repeat(() => player.sendRubbish(), () => refused() > before);
  await player.sendImage(2);
  await repeat(() => player.sendInfo(2), () => /the sensor is back/.test(player.child.said()));
  const { status, said } = await player.stop();
  assert.equal(status, 0, said);
  assert.match(said, /the sensor is back/);
  const good = trajectory(file("restart.csv")).filter((row) => row.status === "ok");
  assert.equal(good.length, 3);
  // The camera may have been moved meanwhile.
  assert.notEqual(good[2].reset_counter, good[1].reset_counter);
});

test("A lens that distorts raw images is refused with what to do", async () => {
  const player = playerOf("distorted");
  const child = run("--sensor", `dds:depth=/distorted/depth/image_raw&${network}`, "--headless");
  // Nobody listens any more once it has ended.
  const send = async () => {
    await player.publish("/distorted/depth/image_raw", "sensor_msgs/Image", "reliable", message(0));
    await player.sendInfo(0, { d: Float64Array.of(0.1, 0, 0, 0, 0) });
  };
  const hasEnded = async () => child.exitCode !== null;
  await repeat(() => send().catch(() => {}), hasEnded);
  const { status, said } = await child.ended;
  assert.equal(status, 3);
  assert.match(said, /\/distorted\/depth\/camera_info: the lens distorts .* subscribe to the rectified topic/);
});

for (const [sensor, link, words, status] of [
  ["dds:domain=0", "", /depth= is missing/, 2],
  ["dds:depth=relative", "", /depth=relative is no topic/, 2],
  ["dds:depth=/a&mask=/b", "", /unknown option mask; there are .*depth, info, rectified, wait/, 2],
  ["dds:depth=/a&name=left", "dds:name=right", /one node in a domain: name= of both/, 2],
  ["dds:depth=/a&interface=nothere9", "", /nothere9/, 3],
  [`dds:depth=/nobody/here&wait=1&${network}`, "", /nobody publishes this sensor_msgs\/msg\/Image/, 3],
]) {
  test(`'${sensor.replaceAll(String(domain), "N")}' is refused with words that help`, async () => {
    const answer = await run("--sensor", sensor, "--headless", ...(link ? ["--link", link] : [])).ended;
    assert.match(answer.said, words);
    assert.equal(answer.status, status);
  });
}
