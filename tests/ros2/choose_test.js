// SPDX-License-Identifier: BSD-3-Clause
// Who is on the network says what is tracked. Usage: node choose_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import { decode, service, writerOf } from "./messages.js";
import { Peer } from "./peer.js";
import { atEnd, ddsType, domain, file, ownBin, patience, run, samplesOf, sleep, until } from "./program.js";

const kSize = { width: 320, height: 180 };
const definition = service(new URL("../../platform/linux/dds/ros2/disflow_msgs/srv/ChooseObject.srv", import.meta.url));
const point = writerOf("geometry_msgs/PointStamped");
const kStamp = { sec: 0, nsec: 0 };
const noMask = { header: { stamp: kStamp, frame_id: "" }, height: 0, width: 0, encoding: "", is_bigendian: 0, step: 0, data: new Uint8Array() };
const odometry = "rt/disflow/object/odometry";

let peer;
let child;
let truth; // Where things are, in the camera's frame; they stand still.
let camera;

before(async () => {
  const scene = ["--object", "box+bottle", "--motion", "static", "--width", String(kSize.width), "--height", String(kSize.height)];
  execFileSync(join(ownBin, "disflow_sim"), [...scene, "--frames", "1", "--mask", "none", file("truth")]);
  const poseOf = (name) => readFileSync(join(file("truth"), "gt", name, "poses.txt"), "utf8").split(" ").slice(0, 3).map(Number);
  truth = { box: poseOf("box"), bottle: poseOf("bottle") };
  camera = JSON.parse(readFileSync(join(file("truth"), "cam_K.json"), "utf8"));
  peer = await Peer.start(join(ownBin, "ros2_peer"), domain);
  await peer.do("subscribe", odometry, ddsType("nav_msgs/Odometry"), "reliable", file("odometry"));
  child = run(
    "--sensor", "sim:box+bottle?motion=static&width=320&height=180&mask=none", "--rate", "realtime", "--frames", "20000", "--headless",
    "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1&camera=eye&choose=yes`,
  );
  await samplesOf(peer, odometry, 3);
});
atEnd(async () => {
  child.kill("SIGTERM");
  const { status, said } = await child.ended;
  await peer.stop();
  assert.equal(status, 0, said);
});

/** Waits until the pose is that of a thing, which has another depth than the other. */
async function untilTracked(thing) {
  const off = () => {
    const { x, y, z } = decode(file("odometry"), "nav_msgs/Odometry").at(-1).pose.pose.position;
    return Math.hypot(...[x, y, z].map((value, i) => value - truth[thing][i]));
  };
  await until(() => off() <= 0.12);
  assert.ok(off() < 0.12, `the ${thing} is ${off()} m off`);
}

let asked = 0;
async function choose(body) {
  const header = { client: 7n, seq: BigInt(++asked) };
  const request = { u: 0, v: 0, width: 0, height: 0, reach: 0, mask: noMask, ...body };
  writeFileSync(file("request"), writerOf(definition.request).writeMessage({ ...header, ...request }));
  const type = "disflow_msgs::srv::dds_::ChooseObject";
  const answer = await peer.do(
    "call", "rq/disflow/object/chooseRequest", `${type}_Request_`, "rr/disflow/object/chooseReply", `${type}_Response_`,
    file("request"), file("reply"),
  );
  assert.equal(answer, "answered");
  return decode(file("reply"), definition.response).at(-1);
}
const pixelOf = ([x, y, z]) => ({ u: Math.round((camera.fx * x) / z + camera.cx), v: Math.round((camera.fy * y) / z + camera.cy) });

async function click(topic, frame_id, [x, y, z]) {
  writeFileSync(file("point"), point.writeMessage({ header: { stamp: kStamp, frame_id }, point: { x, y, z } }));
  assert.equal(await peer.do("publish", topic, ddsType("geometry_msgs/PointStamped"), "reliable", file("point")), "published");
}

test("a pixel, a box and a mask choose what is tracked", async () => {
  await untilTracked("box");
  assert.deepEqual({ ...(await choose({ ...pixelOf(truth.bottle), reach: 3 })), client: 0, seq: 0 }, { success: true, message: "", client: 0, seq: 0 });
  await untilTracked("bottle");
  const { u, v } = pixelOf(truth.box);
  assert.ok((await choose({ u: u - 40, v: v - 40, width: 80, height: 80 })).success);
  await untilTracked("box");
  const data = new Uint8Array(kSize.width * kSize.height);
  const at = pixelOf(truth.bottle);
  for (let y = -15; y < 15; ++y) data.fill(255, (at.v + y) * kSize.width + at.u - 8, (at.v + y) * kSize.width + at.u + 8);
  const mask = { ...noMask, ...kSize, encoding: "mono8", step: kSize.width, data };
  assert.ok((await choose({ mask })).success);
  await untilTracked("bottle");
});

test("what cannot be is refused in words, and loses nothing", async () => {
  await untilTracked("bottle");
  const outside = await choose({ u: 320, v: 10 });
  assert.equal(outside.success, false);
  assert.match(outside.message, /320 x 180/);
  const mask = { ...noMask, width: 10, height: 10, encoding: "mono8", step: 10, data: new Uint8Array(100) };
  const small = await choose({ mask });
  assert.equal(small.success, false);
  assert.match(small.message, /as large as the depth image/);
  await untilTracked("bottle");
});

test("a point that is clicked in RViz chooses too, if it is in the camera's frame", async () => {
  await click("rt/clicked_point", "eye", truth.box);
  await untilTracked("box");
  await click("rt/clicked_point", "nowhere", truth.bottle);
  await sleep(500 * patience);
  await untilTracked("box");
  await click("rt/disflow/object/clicked_point", "eye", truth.bottle);
  await untilTracked("bottle");
});
