// SPDX-License-Identifier: BSD-3-Clause
// One run of disflow_track --link dds:, seen by an independent DDS participant (Fast DDS) and decoded by
// an independent decoder from ROS's own message definitions. Usage: node ros2_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { decode } from "./messages.js";
import { Peer } from "./peer.js";
import { covariance, float, stampNs, trajectory } from "./trajectory.js";

const bin = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), "disflow-ros2-"));
const file = (name) => join(folder, name);
const domain = 20 + (process.pid % 80);
const prefix = "rt/disflow/object/";

const topics = {
  odometry: [prefix + "odometry", "nav_msgs/Odometry", "reliable"],
  pose: [prefix + "pose", "geometry_msgs/PoseWithCovarianceStamped", "reliable"],
  twist: [prefix + "twist", "geometry_msgs/TwistWithCovarianceStamped", "reliable"],
  status: [prefix + "status", "diagnostic_msgs/DiagnosticArray", "reliable"],
  path: [prefix + "path", "nav_msgs/Path", "latched"],
  tf: ["rt/tf", "tf2_msgs/TFMessage", "reliable"],
};
const ddsType = (type) => type.replace("/", "::msg::dds_::") + "_";
const received = (name) => decode(file(name), topics[name][1]);
const nanoseconds = (stamp) => BigInt(stamp.sec) * 1000000000n + BigInt(stamp.nanosec ?? stamp.nsec);

let rows;
let good;
let track;

function run(...options) {
  const child = spawn(join(bin, "disflow_track"), options, { stdio: ["ignore", "ignore", "pipe"] });
  let said = "";
  child.stderr.on("data", (data) => (said += data));
  child.ended = new Promise((resolve) => child.once("exit", (status) => resolve({ status, said })));
  return child;
}

before(async () => {
  const peer = await Peer.start(join(bin, "ros2_peer"), domain);
  for (const [name, [topic, type, qos]] of Object.entries(topics)) {
    assert.equal(await peer.do("subscribe", topic, ddsType(type), qos, file(name)), "subscribed");
  }
  const child = run(
    "--sensor", "sim:bottle?motion=fast&noise=d415", "--rate", "realtime", "--frames", "90", "--headless",
    "--csv", file("pose.csv"), "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1`,
  );
  track = await child.ended;
  await peer.stop();
  assert.equal(track.status, 0, track.said);
  rows = trajectory(file("pose.csv"));
  good = rows.filter((row) => row.status === "ok");
  assert.ok(good.length > 60, "a run that tracks");
});
after(() => rmSync(folder, { recursive: true }));

test("Reliable topics bring every frame, in order", () => {
  assert.equal(received("status").length, rows.length);
  for (const name of ["odometry", "pose", "twist", "tf"]) {
    assert.equal(received(name).length, good.length, name);
  }
});

test("Stamps are capture times, all by the same offset", () => {
  const first = nanoseconds(received("pose")[0].header.stamp) - stampNs(good[0]);
  const sent = { odometry: received("odometry"), pose: received("pose"), twist: received("twist") };
  for (const [name, messages] of Object.entries(sent)) {
    messages.forEach((message, i) => {
      assert.equal(nanoseconds(message.header.stamp) - stampNs(good[i]), first, name);
    });
  }
  const age = BigInt(Date.now()) * 1000000n - nanoseconds(sent.pose.at(-1).header.stamp);
  assert.ok(age > 0n && age < 60000000000n, `a replay looks as if it happened now, not ${age} ns ago`);
});

test("Poses and their covariances are those of the run, in the camera's frame", () => {
  for (const name of ["pose", "odometry"]) {
    received(name).forEach((message, i) => {
      const { position, orientation } = message.pose.pose;
      assert.equal(message.header.frame_id, "camera_optical_frame");
      for (const axis of ["x", "y", "z"]) {
        assert.equal(position[axis], float(good[i][axis]));
        assert.equal(orientation[axis], float(good[i]["q" + axis]));
      }
      assert.equal(orientation.w, float(good[i].qw));
      assert.deepEqual([...message.pose.covariance], covariance(good[i], "pose"));
    });
  }
});

test("The twist is in the camera's axes, with its covariance", () => {
  received("twist").forEach((message, i) => {
    const { linear, angular } = message.twist.twist;
    for (const axis of ["x", "y", "z"]) {
      assert.equal(linear[axis], float(good[i]["v" + axis]));
      assert.equal(angular[axis], float(good[i]["w" + axis]));
    }
    assert.deepEqual([...message.twist.covariance], covariance(good[i], "twist"));
  });
});

/** A vector of the object's frame in the camera's axes. */
function turned(q, v) {
  const cross = (a, b) => ({ x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x });
  const t = cross(q, v);
  const u = cross(q, t);
  return { x: v.x + 2 * (q.w * t.x + u.x), y: v.y + 2 * (q.w * t.y + u.y), z: v.z + 2 * (q.w * t.z + u.z) };
}

test("Odometry carries the same twist in its child's frame", () => {
  received("odometry").forEach((message, i) => {
    assert.equal(message.child_frame_id, "disflow/object");
    const q = message.pose.pose.orientation;
    const linear = turned(q, message.twist.twist.linear);
    const angular = turned(q, message.twist.twist.angular);
    for (const axis of ["x", "y", "z"]) {
      assert.ok(Math.abs(linear[axis] - Number(good[i]["v" + axis])) < 1e-5);
      assert.ok(Math.abs(angular[axis] - Number(good[i]["w" + axis])) < 1e-5);
    }
    // What does not depend on the axes.
    const trace = (matrix, from) => matrix[7 * from] + matrix[7 * from + 7] + matrix[7 * from + 14];
    const own = covariance(good[i], "twist");
    for (const from of [0, 3]) {
      const expected = trace(own, from);
      assert.ok(Math.abs(trace(message.twist.covariance, from) - expected) <= 1e-4 * expected);
    }
  });
});

test("tf says the same as the pose", () => {
  received("tf").forEach((message, i) => {
    assert.equal(message.transforms.length, 1);
    const [{ header, child_frame_id, transform }] = message.transforms;
    assert.equal(header.frame_id, "camera_optical_frame");
    assert.equal(child_frame_id, "disflow/object");
    assert.equal(transform.translation.z, float(good[i].z));
    assert.equal(transform.rotation.w, float(good[i].qw));
  });
});

test("The path ends with every pose of the run", () => {
  const { header, poses } = received("path").at(-1);
  assert.equal(poses.length, good.length);
  assert.deepEqual(header.stamp, poses.at(-1).header.stamp);
  poses.forEach(({ pose }, i) => assert.equal(pose.position.x, float(good[i].x)));
});

test("The status names state, verdict and numbers of its frame", () => {
  received("status").forEach((message, i) => {
    const [status] = message.status;
    const values = Object.fromEntries(status.values.map(({ key, value }) => [key, value]));
    assert.equal(status.name, "disflow: object");
    assert.equal(values.frame, rows[i].frame);
    assert.equal(values.state, rows[i].state);
    assert.equal(values.status, rows[i].status);
    assert.equal(float(values.score), float(rows[i].score));
    assert.equal(values.results_lost, "0");
  });
});

test("The run says what was sent", () => {
  assert.match(track.said, /dds:.*: \d+ messages sent, 0 failed, 0 results too late/);
});

for (const [address, message] of [
  ["dds:", /write dds:domain=0/],
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
