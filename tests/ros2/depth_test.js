// SPDX-License-Identifier: BSD-3-Clause
// Depth images from ROS 2: what an independent DDS participant (Fast DDS) plays is tracked as the same frames
// from a folder are. Usage: node depth_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import { metres, packed, packedMillimetres, raw } from "./encodings.js";
import { millimetres, png, quantised, readFrames, stampLines, writeRecording } from "./frames.js";
import { decode } from "./messages.js";
import { Peer } from "./peer.js";
import { Player, stampOf } from "./player.js";
import { atEnd, domain, file, finished, ownBin, run } from "./program.js";
import { stampNs, trajectory } from "./trajectory.js";

const kFrames = 30;
const common = ["--headless", "--no-timing", "--mesh", file("unused.ply")];

let camera;
let frames;
let peer;

before(async () => {
  const source = "sim:box?motion=moderate&noise=white&width=160&height=120";
  await finished("--sensor", source, "--frames", String(kFrames), "--headless", "--record", file("simulated"));
  camera = JSON.parse(readFileSync(join(file("simulated"), "cam_K.json")));
  frames = readFrames(file("simulated"), kFrames);
  peer = await Peer.start(join(ownBin, "ros2_peer"), domain);
});
atEnd(() => peer.stop());

const sinceEpoch = Array.from({ length: kFrames }, (_, i) => 1789012345678901234n + BigInt(i) * 33333333n);
/** Those that replay: gives a folder of PNG. */
const fromOne = Array.from({ length: kFrames }, (_, i) => 1000000000n + (BigInt(i) * 1000000000n) / 30n);

async function replay(folder, name) {
  await finished("--sensor", `replay:${folder}?mask=none`, ...common, "--csv", file(`${name}.csv`));
}

function assertSameTrajectory(name, expected) {
  const [seen, wanted] = [trajectory(file(`${name}.csv`)), trajectory(file(`${expected}.csv`))];
  assert.equal(wanted.filter((row) => row.status === "ok").length, kFrames, "a run that tracks");
  assert.deepEqual(seen, wanted);
}

const nothing = { width: 0, height: 0, metres: new Float32Array() };

/** A recording of float images with these stamps. */
const floats = (folder, images) => writeRecording(folder, camera, sinceEpoch, images);
function pictures(folder) {
  mkdirSync(join(folder, "depth"), { recursive: true });
  writeFileSync(join(folder, "cam_K.json"), JSON.stringify(camera));
  writeFileSync(join(folder, "data.txt"), stampLines(fromOne));
  frames.forEach((frame, i) =>
    writeFileSync(join(folder, "depth", `${i}.png`), png(frame.width, frame.height, millimetres(frame))),
  );
}

for (const { name, qos, topic, stamps, type, encode, record } of [
  { name: "metres", qos: "reliable", topic: "image_raw", stamps: sinceEpoch,
    ...raw("32FC1", metres), record: (folder) => floats(folder, frames) },
  { name: "odd_rows", qos: "best_effort", topic: "image_rect", stamps: sinceEpoch,
    ...raw("32FC1", metres, { padding: 3, bigEndian: true }), record: (folder) => floats(folder, frames) },
  { name: "millimetres", qos: "best_effort", topic: "image_rect_raw", stamps: fromOne,
    ...raw("16UC1", millimetres, { padding: 64 }), record: pictures },
  { name: "pngs", qos: "best_effort", topic: "image_rect_raw/compressedDepth", stamps: fromOne,
    ...packed("16UC1; compressedDepth png", packedMillimetres), record: pictures },
  { name: "quantised", qos: "reliable", topic: "image/compressedDepth", stamps: sinceEpoch,
    ...packed("32FC1; compressedDepth", (frame) => quantised(frame).data),
    record: (folder) => floats(folder, frames.map((frame) => quantised(frame).frame)) },
]) {
  test(`Images of ${name} by a ${qos} writer give the trajectory that their replay gives`, async () => {
    record(file(`${name}.replay`));
    await replay(file(`${name}.replay`), "replayed");
    const fullTopic = `/${name}/depth/${topic}`;
    const player = new Player({ peer, camera, name, qos, stamps });
    const publish = (frame, stamp) => player.publish(fullTopic, type, qos, encode(frame, stamp));
    player.sendImage = (i) => publish(frames[i], stamps[i]);
    player.sendRubbish = () => publish(nothing, stamps[0]);
    const { status, said } = await player.play(
      "--sensor", `dds:domain=${domain}&depth=${fullTopic}&name=${name}`, ...common, "--csv", file(`${name}.csv`),
      "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1`,
    );
    assert.equal(status, 0, said);
    assertSameTrajectory(name, "replayed");
    // What goes out is dated as what came in, to the nanosecond.
    const sent = decode(file(`${name}.status`), "diagnostic_msgs/DiagnosticArray");
    assert.deepEqual(sent.map(({ header }) => header.stamp), stamps.map(stampOf));
    assert.deepEqual(trajectory(file(`${name}.csv`)).map(stampNs), stamps);
  });
}
