// SPDX-License-Identifier: BSD-3-Clause
// Recordings of ROS 2: files by Foxglove's writer are tracked as the same frames from a folder are.
// Usage: node bag_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import zstd from "@foxglove/wasm-zstd";
import { McapWriter } from "@mcap/core";
import { metres, packed, packedMillimetres, raw } from "./encodings.js";
import { cameraInfo, millimetres, png, quantised, readFrames, stampLines, writeRecording } from "./frames.js";
import { writerOf } from "./messages.js";
import { headerOf } from "./player.js";
import { file, finished } from "./program.js";
import { trajectory } from "./trajectory.js";

const kFrames = 30;
const stamps = Array.from({ length: kFrames }, (_, i) => 1789012345678901234n + BigInt(i) * 33333333n);
const common = ["--headless", "--no-timing"];
const info = writerOf("sensor_msgs/CameraInfo");

let camera;
let frames;

before(async () => {
  await zstd.isLoaded;
  const source = "sim:box?motion=moderate&noise=white&width=160&height=120";
  await finished("--sensor", source, "--frames", String(kFrames), "--headless", "--record", file("simulated"));
  camera = JSON.parse(readFileSync(join(file("simulated"), "cam_K.json")));
  frames = readFrames(file("simulated"), kFrames);
});

const floats = (images) => (folder) => writeRecording(folder, camera, stamps, images());
function pictures(folder) {
  mkdirSync(join(folder, "depth"), { recursive: true });
  writeFileSync(join(folder, "cam_K.json"), JSON.stringify(camera));
  writeFileSync(join(folder, "data.txt"), stampLines(stamps));
  frames.forEach((frame, i) =>
    writeFileSync(join(folder, "depth", `${i}.png`), png(frame.width, frame.height, millimetres(frame))),
  );
}

/** What is recorded: image and intrinsics of each frame, in either order. */
function messagesOf({ topic, type, encode }) {
  return frames.flatMap((frame, i) => {
    const infoTopic = topic.replace(/image.*/, "camera_info");
    const both = [
      { topic, type: type.replace("/", "/msg/"), data: encode(frame, stamps[i]) },
      { topic: infoTopic, type: "sensor_msgs/msg/CameraInfo", data: info.writeMessage(cameraInfo(headerOf(stamps[i]), camera)) },
    ];
    return i % 2 === 0 ? both : both.reverse();
  });
}

/** By Foxglove's writer. */
async function writeMcap(path, messages, options) {
  const parts = [];
  let size = 0;
  const writable = {
    position: () => BigInt(size),
    write: async (bytes) => {
      parts.push(Buffer.from(bytes));
      size += bytes.length;
    },
  };
  const writer = new McapWriter({ writable, ...options });
  await writer.start({ profile: "ros2", library: "test" });
  const channels = new Map();
  let sequence = 0;
  for (const { topic, type, data } of messages) {
    if (!channels.has(topic)) {
      const schemaId = await writer.registerSchema({ name: type, encoding: "ros2msg", data: new Uint8Array() });
      channels.set(topic, await writer.registerChannel({ topic, schemaId, messageEncoding: "cdr", metadata: new Map() }));
    }
    const time = stamps[0] + BigInt(sequence) * 1000000n;
    await writer.addMessage({ channelId: channels.get(topic), sequence: sequence++, logTime: time, publishTime: time, data });
  }
  await writer.end();
  writeFileSync(path, Buffer.concat(parts));
}

/** As rosbag2_storage_sqlite3 does it, by Python's SQLite. */
function writeDb3(path, messages) {
  const program = `
import json, sqlite3, sys
database = sqlite3.connect(sys.argv[1])
database.execute("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)")
database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                 "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
database.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
topics = {}
for i, line in enumerate(sys.stdin):
    message = json.loads(line)
    if message["topic"] not in topics:
        topics[message["topic"]] = len(topics) + 1
        database.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (len(topics), message["topic"], message["type"]))
    database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                     (topics[message["topic"]], i, bytes.fromhex(message["data"])))
database.commit()`;
  const lines = messages.map((one) => JSON.stringify({ ...one, data: Buffer.from(one.data).toString("hex") }));
  const { status, stderr } = spawnSync("python3", ["-c", program, path], { input: lines.join("\n") });
  assert.equal(status, 0, String(stderr));
}

const compressChunk = (data) => ({ compression: "zstd", compressedData: zstd.compress(Buffer.from(data), 1) });
const kinds = [
  { name: "metres", topic: "/c/depth/image_raw", ...raw("32FC1", metres), record: floats(() => frames) },
  { name: "millimetres", topic: "/c/depth/image_rect_raw", ...raw("16UC1", millimetres), record: pictures },
  { name: "pngs", topic: "/c/depth/image_rect_raw/compressedDepth", ...packed("16UC1; compressedDepth png", packedMillimetres),
    record: pictures },
  { name: "quantised", topic: "/c/depth/image/compressedDepth",
    ...packed("32FC1; compressedDepth", (frame) => quantised(frame).data),
    record: floats(() => frames.map((frame) => quantised(frame).frame)) },
];

/** Runs a recording and a folder with the same frames: the same bits must come of both. */
async function assertSameAsReplay(path, kind) {
  kind.record(file(`${kind.name}.replay`));
  await finished("--sensor", `replay:${file(`${kind.name}.replay`)}?mask=none`, ...common, "--csv", file("replayed.csv"));
  await finished("--sensor", `rosbag:${path}?depth=${kind.topic}`, ...common, "--csv", file("bag.csv"));
  const wanted = trajectory(file("replayed.csv"));
  assert.equal(wanted.filter((row) => row.status === "ok").length, kFrames, "a run that tracks");
  assert.deepEqual(trajectory(file("bag.csv")), wanted);
}

for (const kind of kinds) {
  for (const [style, options] of [
    ["chunks", {}],
    ["zstd chunks of one message", { compressChunk, chunkSize: 1 }],
    ["no chunks and no index", { useChunks: false, useSummaryOffsets: false, useStatistics: false }],
  ]) {
    test(`MCAP in ${style} with ${kind.name} gives the trajectory that the frames' replay gives`, async () => {
      await writeMcap(file("run.mcap"), messagesOf(kind), options);
      await assertSameAsReplay(file("run.mcap"), kind);
    });
  }
  test(`A database with ${kind.name} gives the trajectory that the frames' replay gives`, async () => {
    writeDb3(file(`${kind.name}.db3`), messagesOf(kind));
    await assertSameAsReplay(file(`${kind.name}.db3`), kind);
  });
}

test("A file whose recorder was killed is played as far as it goes, and the run says so", async () => {
  await writeMcap(file("whole.mcap"), messagesOf(kinds[1]), { chunkSize: 1 });
  const whole = readFileSync(file("whole.mcap"));
  writeFileSync(file("cut.mcap"), whole.subarray(0, whole.length >> 1));
  const said = await finished("--sensor", `rosbag:${file("cut.mcap")}?depth=${kinds[1].topic}`, ...common, "--csv", file("cut.csv"));
  assert.match(said, /cut short/);
  const rows = trajectory(file("cut.csv"));
  assert.ok(rows.length > 5 && rows.length < kFrames, `${rows.length} rows`);
});
