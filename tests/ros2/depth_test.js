// SPDX-License-Identifier: BSD-3-Clause
// Depth images from ROS 2: what an independent DDS participant (Fast DDS) plays is tracked as the same frames
// from a folder are. Usage: node depth_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cameraInfo, millimetres, png, quantised, readFrames, rows, writeRecording } from "./frames.js";
import { decode, writerOf } from "./messages.js";
import { Peer } from "./peer.js";
import { bin, ddsType, domain, file, run, samplesOf, sleep } from "./program.js";
import { stampNs, trajectory } from "./trajectory.js";

const kFrames = 30;
const image = writerOf("sensor_msgs/Image");
const compressed = writerOf("sensor_msgs/CompressedImage");
const info = writerOf("sensor_msgs/CameraInfo");
const network = `domain=${domain}&interface=lo&peer=127.0.0.1`;
const common = ["--headless", "--no-timing", "--mesh", file("unused.ply")];

let camera;
let frames;
let peer;

/** Runs to its end. */
async function finished(...options) {
  const { status, said } = await run(...options).ended;
  assert.equal(status, 0, said);
  return said;
}

before(async () => {
  const source = "sim:box?motion=moderate&noise=white&width=160&height=120";
  await finished("--sensor", source, "--frames", String(kFrames), "--headless", "--record", file("simulated"));
  camera = JSON.parse(readFileSync(join(file("simulated"), "cam_K.json")));
  frames = readFrames(file("simulated"), kFrames);
  peer = await Peer.start(join(bin, "ros2_peer"), domain);
});
after(() => peer.stop());

const stampOf = (ns) => ({ sec: Number(ns / 1000000000n), nanosec: Number(ns % 1000000000n) });
/** The encoder's stamps have another name for it. */
const headerOf = (ns) => ({
  stamp: { sec: stampOf(ns).sec, nsec: stampOf(ns).nanosec },
  frame_id: "camera_depth_optical_frame",
});
const sinceEpoch = Array.from({ length: kFrames }, (_, i) => 1789012345678901234n + BigInt(i) * 33333333n);
/** Those that replay: gives a folder of PNG. */
const fromOne = Array.from({ length: kFrames }, (_, i) => 1000000000n + (BigInt(i) * 1000000000n) / 30n);

async function publish(topic, type, qos, bytes) {
  writeFileSync(file("sample"), bytes);
  assert.equal(await peer.do("publish", topic, ddsType(type), qos, file("sample")), "published");
}

/** Again and again until it has worked: what a best-effort writer sends is lost until the other side knows it. */
async function repeat(send, worked) {
  for (let i = 0; i < 100 && !(await worked()); ++i) {
    await send();
    await sleep(100);
  }
}

/**
 * Plays images one after the other, each when the one before has been tracked.
 * @param send Publishes the image of that index.
 * @param rubbish Publishes something that is no image.
 */
async function play({ name, topic, qos, stamps, send, rubbish }) {
  const status = `rt/${name}/object/status`;
  await peer.do("subscribe", status, ddsType("diagnostic_msgs/DiagnosticArray"), "reliable", file(`${name}.status`));
  const child = run(
    "--sensor", `dds:domain=${domain}&depth=${topic}&name=${name}`, ...common, "--csv", file(`${name}.csv`),
    "--link", `dds:${network}`,
  );
  const sendInfo = (i) =>
    publish(`rt/${name}/depth/camera_info`, "sensor_msgs/CameraInfo", qos, info.writeMessage(cameraInfo(headerOf(stamps[i]), camera)));
  const tracked = async (count) => Number(await peer.do("count", status)) >= count;
  // It says what is wrong as long as it has no image: then it hears.
  await repeat(rubbish, () => /0 x 0 pixels/.test(child.said()));
  await send(0);
  await repeat(() => sendInfo(0), () => tracked(1));
  for (let i = 1; i < stamps.length; ++i) {
    const both = [() => send(i), () => sendInfo(i)];
    // Drivers send them in either order.
    if (i % 2 === 0) both.reverse();
    for (const one of both) await one();
    await samplesOf(peer, status, i + 1);
    assert.ok(await tracked(i + 1), `frame ${i} has come and gone; ${child.said()}`);
  }
  child.kill("SIGTERM");
  const ended = await child.ended;
  assert.equal(ended.status, 0, ended.said);
}

async function replay(folder, name) {
  await finished("--sensor", `replay:${folder}?mask=none`, ...common, "--csv", file(`${name}.csv`));
}

function assertSameTrajectory(name, expected) {
  const [seen, wanted] = [trajectory(file(`${name}.csv`)), trajectory(file(`${expected}.csv`))];
  assert.equal(wanted.filter((row) => row.status === "ok").length, kFrames, "a run that tracks");
  assert.deepEqual(seen, wanted);
}

const raw = (encoding, values, { padding = 0, bigEndian = false } = {}) => ({
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
const metres = ({ metres }) => metres;
const packed = (format, data) => ({
  type: "sensor_msgs/CompressedImage",
  encode: (frame, stamp) => compressed.writeMessage({ header: headerOf(stamp), format, data: data(frame) }),
});
const packedMillimetres = (frame) => {
  const values = frame.width > 0 ? millimetres(frame) : new Uint16Array();
  return new Uint8Array(Buffer.concat([Buffer.alloc(12), png(frame.width, frame.height, values)]));
};
const nothing = { width: 0, height: 0, metres: new Float32Array() };

/** A recording of float images with these stamps. */
const floats = (folder, images) => writeRecording(folder, camera, sinceEpoch, images);
function pictures(folder) {
  mkdirSync(join(folder, "depth"), { recursive: true });
  writeFileSync(join(folder, "cam_K.json"), JSON.stringify(camera));
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
    const publishImage = (frame, stamp) => publish("rt" + fullTopic, type, qos, encode(frame, stamp));
    await play({
      name, topic: fullTopic, qos, stamps,
      send: (i) => publishImage(frames[i], stamps[i]),
      rubbish: () => publishImage(nothing, stamps[0]),
    });
    assertSameTrajectory(name, "replayed");
    // What goes out is dated as what came in, to the nanosecond.
    const sent = decode(file(`${name}.status`), "diagnostic_msgs/DiagnosticArray");
    assert.deepEqual(sent.map(({ header }) => header.stamp), stamps.map(stampOf));
    assert.deepEqual(trajectory(file(`${name}.csv`)).map(stampNs), stamps);
  });
}
