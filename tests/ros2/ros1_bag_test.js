// SPDX-License-Identifier: BSD-3-Clause
// Bags of ROS 1: files by ROS 1's own rosbag (Debian's python3-rosbag) are tracked as the folder that they were made of is.
// Usage: node ros1_bag_test.js BIN_FOLDER [FOLDER_OF_THIS_MACHINE'S_OWN]
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { millimetres, png, readFrames } from "./frames.js";
import { file, finished, ownBin } from "./program.js";
import { trajectory } from "./trajectory.js";

const kFrames = 30;
const kDepth = "/camera/depth/image_rect_raw";
// Debian's Python, whose packages these are; another may come first in PATH.
const kPython = "/usr/bin/python3";
const writer = fileURLToPath(new URL("write_bag.py", import.meta.url));
const common = ["--headless", "--no-timing"];
const isMissing = spawnSync(kPython, ["-c", "import rosbag, rospy, sensor_msgs.msg"]).status !== 0;
// On CI nothing may be skipped.
const skip = isMissing && !process.env.CI && "python3-rosbag or python3-sensor-msgs is missing";

/** The trajectory of each encoding's frames, played from a folder. */
const replayed = {};

async function replay(folder) {
  await finished("--sensor", `replay:${file(folder)}?mask=none`, ...common, "--csv", file(`${folder}.csv`));
  const rows = trajectory(file(`${folder}.csv`));
  assert.equal(rows.filter((row) => row.status === "ok").length, kFrames, "a run that tracks");
  return rows;
}

/** The same frames, rounded to millimetres. */
function writeMillimetres(from, to) {
  mkdirSync(join(to, "depth"), { recursive: true });
  for (const name of ["cam_K.json", "data.txt"]) cpSync(join(from, name), join(to, name));
  readFrames(from, kFrames).forEach((frame, i) =>
    writeFileSync(join(to, "depth", `${i}.png`), png(frame.width, frame.height, millimetres(frame))),
  );
}

function writeBag(path, ...how) {
  const { status, stderr } = spawnSync(kPython, ["-B", writer, file("metres"), path, ...how]);
  assert.equal(status, 0, String(stderr));
}

before(async () => {
  if (skip) return;
  const { status, stderr } = spawnSync(join(ownBin, "disflow_sim"), [
    "--object", "box", "--motion", "moderate", "--noise", "white", "--width", "160", "--height", "120", "--frames", String(kFrames),
    file("metres"),
  ]);
  assert.equal(status, 0, String(stderr));
  writeMillimetres(file("metres"), file("millimetres"));
  replayed["32FC1"] = await replay("metres");
  replayed["16UC1"] = await replay("millimetres");
});

for (const compression of ["none", "lz4", "bz2"]) {
  for (const encoding of ["32FC1", "16UC1"]) {
    test(`A bag with ${encoding}, packed by ${compression}, gives the trajectory that its frames' replay gives`, { skip }, async () => {
      writeBag(file("run.bag"), encoding, compression);
      await finished("--sensor", `rosbag:${file("run.bag")}?depth=${kDepth}`, ...common, "--csv", file("bag.csv"));
      assert.deepEqual(trajectory(file("bag.csv")), replayed[encoding]);
    });
  }
}

test("A bag whose recorder was killed is played as far as its chunks are whole, and the run says so", { skip }, async () => {
  writeBag(file("killed.bag"), "32FC1", "lz4", "--killed");
  const said = await finished("--sensor", `rosbag:${file("killed.bag")}?depth=${kDepth}`, ...common, "--csv", file("killed.csv"));
  assert.match(said, /cut short/);
  const rows = trajectory(file("killed.csv"));
  assert.ok(rows.length > 5, `${rows.length} rows`);
  assert.deepEqual(rows, replayed["32FC1"].slice(0, rows.length));
});
