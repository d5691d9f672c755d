// SPDX-License-Identifier: BSD-3-Clause
// What --record FILE.mcap writes: Foxglove's reader finds in it, by the definitions that the file itself holds, the
// values of the same run's CSV; and played again it is the same run. Usage: node record_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { open } from "node:fs/promises";
import { before, test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { points } from "./clouds.js";
import { millimetres, png } from "./frames.js";
import { readerOf } from "./messages.js";
import { file, finished, run } from "./program.js";
import { covariance, float, stampNs, trajectory } from "./trajectory.js";

const kFrames = 40;
const common = ["--headless", "--no-timing"];
const depth = "/disflow/depth/image_rect_raw";
const types = {
  [depth]: "sensor_msgs/msg/Image",
  "/disflow/depth/camera_info": "sensor_msgs/msg/CameraInfo",
  "/disflow/mask": "sensor_msgs/msg/Image",
  "/tf": "tf2_msgs/msg/TFMessage",
  "/disflow/object/odometry": "nav_msgs/msg/Odometry",
  "/disflow/object/status": "diagnostic_msgs/msg/DiagnosticArray",
  "/disflow/object/cloud": "sensor_msgs/msg/PointCloud2",
};
const nanoseconds = (stamp) => BigInt(stamp.sec) * 1000000000n + BigInt(stamp.nanosec ?? stamp.nsec);

/** Messages by topic, by the file's own schemas. */
function decodeAll(schemas, channels, messages) {
  const readers = new Map();
  const decoded = Object.fromEntries([...channels.values()].map(({ topic }) => [topic, []]));
  for (const { channelId, data } of messages) {
    const { schemaId, topic, messageEncoding } = channels.get(channelId);
    assert.equal(messageEncoding, "cdr");
    if (!readers.has(schemaId)) {
      const { encoding, data: text } = schemas.get(schemaId);
      assert.equal(encoding, "ros2msg");
      readers.set(schemaId, new MessageReader(parse(new TextDecoder().decode(text), { ros2: true })));
    }
    decoded[topic].push(readers.get(schemaId).readMessage(data));
  }
  return decoded;
}

/** By the index at the end of the file, from the disk as Foxglove's own programs read it. */
async function readByIndex(path) {
  const handle = await open(path);
  try {
    const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(handle) });
    const messages = [];
    // What is read next may overwrite the bytes that a message points to.
    for await (const message of reader.readMessages()) messages.push({ ...message, data: message.data.slice() });
    return { reader, schemas: reader.schemasById, channels: reader.channelsById, messages };
  } finally {
    await handle.close();
  }
}

/** From front to end, as far as it goes; checks the checksums. */
function readAsStream(path) {
  const stream = new McapStreamReader({ validateCrcs: true });
  stream.append(readFileSync(path));
  const [schemas, channels, messages] = [new Map(), new Map(), []];
  for (let record; (record = stream.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") messages.push(record);
  }
  return { done: stream.done(), schemas, channels, messages };
}

/** The frames that a cloud goes with: the first, and the next half a second later. */
function cloudsIn(frames) {
  let last;
  return frames.filter((row) => {
    const due = last === undefined || stampNs(row) - last >= 500000000n;
    if (due) last = stampNs(row);
    return due;
  });
}

let rows;
let good;
let indexed;
let topics;

before(async () => {
  const source = "sim:box?motion=moderate&noise=white&width=160&height=120&drop=0.1";
  await finished("--sensor", source, "--frames", String(kFrames), ...common, "--record", file("run.mcap"), "--csv", file("run.csv"));
  rows = trajectory(file("run.csv"));
  good = rows.filter((row) => row.status === "ok");
  indexed = await readByIndex(file("run.mcap"));
  topics = decodeAll(indexed.schemas, indexed.channels, indexed.messages);
});

test("Every topic is there with its type, and every frame and measured pose is in it", () => {
  assert.ok(good.length > 20);
  for (const { topic, schemaId } of indexed.channels.values()) {
    assert.equal(indexed.schemas.get(schemaId).name, types[topic], topic);
  }
  const counts = Object.fromEntries(Object.entries(topics).map(([topic, messages]) => [topic, messages.length]));
  assert.deepEqual(counts, {
    [depth]: rows.length, "/disflow/depth/camera_info": rows.length, "/disflow/mask": rows.length,
    "/tf": good.length, "/disflow/object/odometry": good.length, "/disflow/object/status": rows.length,
    "/disflow/object/cloud": cloudsIn(rows).length,
  });
  assert.equal(Number(indexed.reader.statistics.messageCount), indexed.messages.length);
  assert.equal(indexed.reader.chunkIndexes.length, rows.length, "a chunk per frame");
});

test("Without the index the file reads the same, and its checksums are right", () => {
  const { done, schemas, channels, messages } = readAsStream(file("run.mcap"));
  assert.ok(done);
  assert.deepEqual(decodeAll(schemas, channels, messages), topics);
});

test("Definitions in the file are ROS's own: both decode every message alike", () => {
  for (const { channelId, data } of indexed.messages) {
    const { topic, schemaId } = indexed.channels.get(channelId);
    const theirs = readerOf(types[topic].replace("/msg/", "/")).readMessage(data);
    const text = new TextDecoder().decode(indexed.schemas.get(schemaId).data);
    assert.deepEqual(new MessageReader(parse(text, { ros2: true })).readMessage(data), theirs, topic);
  }
});

test("Poses, twists and covariances are those of the run, stamped as it was", () => {
  topics["/disflow/object/odometry"].forEach((message, i) => {
    const { position, orientation } = message.pose.pose;
    assert.equal(nanoseconds(message.header.stamp), stampNs(good[i]));
    assert.equal(message.child_frame_id, "disflow/object");
    for (const axis of ["x", "y", "z"]) {
      assert.equal(position[axis], float(good[i][axis]));
      assert.equal(orientation[axis], float(good[i]["q" + axis]));
    }
    assert.deepEqual([...message.pose.covariance], covariance(good[i], "pose"));
    const [transform] = topics["/tf"][i].transforms;
    assert.deepEqual(transform.transform.translation, position);
    assert.deepEqual(transform.transform.rotation, orientation);
  });
  const value = (message, key) => message.status[0].values.find((pair) => pair.key === key).value;
  assert.deepEqual(topics["/disflow/object/status"].map((message) => value(message, "status")), rows.map((row) => row.status));
});

test("The model's cloud is there twice a second, near the object's origin, with normals of length 1", () => {
  const clouds = topics["/disflow/object/cloud"];
  assert.deepEqual(clouds.map(({ header }) => nanoseconds(header.stamp)), cloudsIn(rows).map(stampNs));
  assert.ok(clouds.length >= 3);
  clouds.forEach((cloud) => {
    assert.equal(cloud.header.frame_id, "disflow/object");
    assert.deepEqual(cloud.fields.map(({ name }) => name), ["x", "y", "z", "normal_x", "normal_y", "normal_z", "std"]);
    assert.equal(cloud.data.length, cloud.width * cloud.point_step);
    for (const { x, y, z, normal_x, normal_y, normal_z, std } of points(cloud)) {
      assert.ok(Math.hypot(x, y, z) < 0.5 && Math.abs(Math.hypot(normal_x, normal_y, normal_z) - 1) < 1e-3 && std > 0);
    }
  });
  assert.ok(clouds.at(-1).width > 100);
});

/** The transforms of a recording by their child frame, and its rows. */
async function motionIn(name) {
  const { schemas, channels, messages } = await readByIndex(file(`${name}.mcap`));
  const transforms = decodeAll(schemas, channels, messages)["/tf"].flatMap((message) => message.transforms);
  const motion = new Map(transforms.map(({ child_frame_id: child }) => [child, []]));
  for (const transform of transforms) motion.get(transform.child_frame_id).push(transform);
  return { motion, rows: trajectory(file(`${name}.csv`)) };
}

test("A camera that moves is in the recording, and played again all is where it was in the world", async () => {
  const source = "sim:box?motion=moderate&width=160&height=120&camera=moving";
  const outputs = (name) => [...common, "--record", file(`${name}.mcap`), "--csv", file(`${name}.csv`)];
  await finished("--sensor", source, "--frames", String(kFrames), ...outputs("moves"));
  const played = `rosbag:${file("moves.mcap")}?depth=${depth}&mask=/disflow/mask`;
  await finished("--sensor", `${played}&world=world`, ...outputs("again"));
  const [first, again] = [await motionIn("moves"), await motionIn("again")];
  const camera = first.motion.get("camera_optical_frame");
  assert.equal(camera.length, kFrames);
  assert.deepEqual(camera.map(({ header }) => nanoseconds(header.stamp)), first.rows.map(stampNs));
  assert.ok(camera.every(({ header }) => header.frame_id === "world"));
  const moved = (i) => Math.hypot(...["x", "y", "z"].map((axis) => camera[i].transform.translation[axis] - camera[0].transform.translation[axis]));
  assert.ok(moved(kFrames - 1) > 0.01, "it did move");
  assert.deepEqual(again.rows.map(({ status }) => status), first.rows.map(({ status }) => status));
  for (const [child, poses] of first.motion) {
    assert.equal(again.motion.get(child).length, poses.length);
    poses.forEach(({ header, transform }, i) => {
      const other = again.motion.get(child)[i];
      assert.deepEqual(other.header, header);
      for (const part of ["translation", "rotation"]) {
        for (const axis of Object.keys(transform[part])) {
          const apart = Math.abs(other.transform[part][axis] - transform[part][axis]);
          assert.ok(apart < 1e-6, `${child} of frame ${i}: ${part} ${axis} is off by ${apart}`);
        }
      }
    });
  }
  const lost = await run("--sensor", `${played}&world=map`, ...common).ended;
  assert.equal(lost.status, 3);
  assert.match(lost.said, /do not lead from map to camera_optical_frame/);
});

test("Played again it is the same run, to the bit", async () => {
  await finished("--sensor", `rosbag:${file("run.mcap")}?depth=${depth}&mask=/disflow/mask`, ...common, "--csv", file("again.csv"));
  // What the camera dropped was never recorded.
  const kept = rows.map((row) => ({ ...row, dropped: "0" }));
  assert.deepEqual(trajectory(file("again.csv")), kept);
});

test("A recording of a recording holds the same images", async () => {
  await finished("--sensor", `rosbag:${file("run.mcap")}?depth=${depth}&mask=/disflow/mask`, ...common,
    "--record", file("copy.mcap"));
  const { schemas, channels, messages } = await readByIndex(file("copy.mcap"));
  assert.deepEqual(decodeAll(schemas, channels, messages)[depth], topics[depth]);
});

test("Millimetres stay millimetres", async () => {
  const images = topics[depth].map(({ width, height, data }) => ({
    width, height, metres: new Float32Array(data.slice().buffer),
  }));
  mkdirSync(file("pictures/depth"), { recursive: true });
  const { width, height, k } = topics["/disflow/depth/camera_info"][0];
  writeFileSync(file("pictures/cam_K.json"), JSON.stringify({ width, height, fx: k[0], fy: k[4], cx: k[2], cy: k[5] }));
  images.forEach((image, i) =>
    writeFileSync(file(`pictures/depth/${i}.png`), png(image.width, image.height, millimetres(image))));
  await finished("--sensor", `replay:${file("pictures")}?fps=30`, ...common, "--record", file("mm.mcap"), "--csv", file("mm.csv"));
  const { schemas, channels, messages } = await readByIndex(file("mm.mcap"));
  decodeAll(schemas, channels, messages)[depth].forEach(({ encoding, data }, i) => {
    assert.equal(encoding, "16UC1");
    assert.deepEqual(new Uint16Array(data.slice().buffer), millimetres(images[i]));
  });
  await finished("--sensor", `rosbag:${file("mm.mcap")}?depth=${depth}`, ...common, "--csv", file("mm_again.csv"));
  assert.deepEqual(trajectory(file("mm_again.csv")), trajectory(file("mm.csv")));
});

test("A file that is cut reads as far as its chunks are whole", async () => {
  const whole = readFileSync(file("run.mcap"));
  writeFileSync(file("cut.mcap"), whole.subarray(0, whole.length >> 1));
  const { done, schemas, channels, messages } = readAsStream(file("cut.mcap"));
  assert.ok(!done);
  const images = decodeAll(schemas, channels, messages)[depth];
  assert.ok(images.length > 5);
  assert.deepEqual(images, topics[depth].slice(0, images.length));
});

test("A file that is there already is not touched", async () => {
  writeFileSync(file("precious.mcap"), "precious");
  const { status, said } = await run("--sensor", "sim:box?frames=3", ...common, "--record", file("precious.mcap")).ended;
  assert.equal(status, 4, said);
  assert.match(said, /precious\.mcap/);
  assert.equal(readFileSync(file("precious.mcap"), "utf8"), "precious");
});
