// SPDX-License-Identifier: BSD-3-Clause
// One run of disflow_track --link dds:, seen by an independent DDS participant (Fast DDS) and decoded by
// an independent decoder from ROS's own message definitions. Usage: node topics_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import { points, triangles } from "./clouds.js";
import { decode, service, writerOf } from "./messages.js";
import { Peer } from "./peer.js";
import { ddsType, domain, file, ownBin, patience, run, samplesOf } from "./program.js";
import { covariance, float, stampNs, trajectory } from "./trajectory.js";

const prefix = "rt/disflow/object/";

const topics = {
  odometry: [prefix + "odometry", "nav_msgs/Odometry", "reliable"],
  pose: [prefix + "pose", "geometry_msgs/PoseWithCovarianceStamped", "reliable"],
  twist: [prefix + "twist", "geometry_msgs/TwistWithCovarianceStamped", "reliable"],
  status: [prefix + "status", "diagnostic_msgs/DiagnosticArray", "reliable"],
  path: [prefix + "path", "nav_msgs/Path", "latched"],
  cloud: [prefix + "cloud", "sensor_msgs/PointCloud2", "best_effort"],
  distance_flow: [prefix + "distance_flow", "sensor_msgs/PointCloud2", "best_effort"],
  surface: [prefix + "surface", "visualization_msgs/Marker", "latched"],
  tf: ["rt/tf", "tf2_msgs/TFMessage", "reliable"],
};
const query = service(new URL("../../platform/linux/dds/ros2/disflow_msgs/srv/QueryDistanceField.srv", import.meta.url));
const received = (name) => decode(file(name), topics[name][1]);
const nanoseconds = (stamp) => BigInt(stamp.sec) * 1000000000n + BigInt(stamp.nanosec ?? stamp.nsec);

/** Calls a service of the first object; header and body of the reply. */
async function call(peer, name, type, definition, body) {
  const header = { client: 0x0123456789abcdefn, seq: BigInt(++call.count) };
  writeFileSync(file("request"), writerOf(definition.request).writeMessage({ ...header, ...body }));
  const answer = await peer.do(
    "call", `rq/disflow/object/${name}Request`, `${type}_Request_`, `rr/disflow/object/${name}Reply`,
    `${type}_Response_`, file("request"), file(`${name}.reply`),
  );
  assert.equal(answer, "answered");
  const reply = decode(file(`${name}.reply`), definition.response).at(-1);
  assert.deepEqual({ client: reply.client, seq: reply.seq }, header, "the header comes back");
  return reply;
}
call.count = 0;
const askDistance = (peer, points) =>
  call(peer, "query_distance_field", "disflow_msgs::srv::dds_::QueryDistanceField", query, { points });

let samplesAsked;
let asked;
let answered;
let tooMuch;
let rows;
let good;
let track;

before(async () => {
  const peer = await Peer.start(join(ownBin, "ros2_peer"), domain);
  for (const [name, [topic, type, qos]] of Object.entries(topics)) {
    assert.equal(await peer.do("subscribe", topic, ddsType(type), qos, file(name)), "subscribed");
  }
  const child = run(
    "--sensor", "sim:bottle?motion=fast&noise=white", "--rate", "realtime", "--frames", "900", "--headless",
    "--csv", file("pose.csv"), "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1`,
  );
  await samplesOf(peer, prefix + "cloud", 3);
  // A little outside of where the model has samples.
  samplesAsked = points(received("cloud").at(-1));
  asked = samplesAsked.map((p) => ({
    x: p.x + 0.004 * p.normal_x, y: p.y + 0.004 * p.normal_y, z: p.z + 0.004 * p.normal_z,
  }));
  answered = await askDistance(peer, [...asked, { x: NaN, y: 0, z: 0 }]);
  tooMuch = await askDistance(peer, new Array(2001).fill({ x: 0, y: 0, z: 0 }));
  await samplesOf(peer, prefix + "status", 120);
  child.kill("SIGTERM");
  track = await child.ended;
  await peer.stop();
  assert.equal(track.status, 0, track.said);
  rows = trajectory(file("pose.csv"));
  good = rows.filter((row) => row.status === "ok");
  assert.ok(good.length > 90, "a run that tracks");
});

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
  assert.ok(age > 0n && age < 60000000000n * BigInt(patience), `a replay looks as if it happened now, not ${age} ns ago`);
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

const normal = (p) => [p.normal_x, p.normal_y, p.normal_z];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

test("The cloud holds the model's samples in the object's frame", () => {
  const clouds = received("cloud");
  assert.ok(clouds.length >= 3, `${clouds.length} clouds`);
  assert.equal(clouds.at(-1).header.frame_id, "disflow/object");
  const samples = points(clouds.at(-1));
  assert.ok(samples.length > 500 && samples.length >= points(clouds[0]).length, "the model grows");
  for (const sample of samples) {
    assert.ok(Math.hypot(sample.x, sample.y, sample.z) < 0.3);
    assert.ok(Math.abs(Math.hypot(...normal(sample)) - 1) < 1e-3);
    assert.ok(sample.std > 0 && sample.std < 0.02);
  }
});

test("The distance flow moves each point with the object, and knows the model near it", () => {
  const flows = received("distance_flow");
  assert.ok(flows.length >= 10, `${flows.length} clouds`);
  const offset = nanoseconds(received("pose")[0].header.stamp) - stampNs(good[0]);
  for (const flow of flows) {
    assert.equal(flow.header.frame_id, "camera_optical_frame");
    const row = rows.find((one) => stampNs(one) + offset === nanoseconds(flow.header.stamp));
    const [v, w, p] = ["v", "w", ""].map((name) => ["x", "y", "z"].map((axis) => Number(row[name + axis])));
    const samples = points(flow);
    assert.equal(samples.length, Number(row.samples));
    for (const sample of samples) {
      const arm = [sample.x - p[0], sample.y - p[1], sample.z - p[2]];
      assert.ok(Math.abs(sample.vx - (v[0] + w[1] * arm[2] - w[2] * arm[1])) < 1e-5);
      assert.ok(Math.abs(sample.vz - (v[2] + w[0] * arm[1] - w[1] * arm[0])) < 1e-5);
    }
    const known = samples.filter((sample) => Math.abs(sample.d) < 0.01);
    assert.ok(known.length > 0.5 * samples.length);
  }
});

test("The surface's triangles lie where the samples are", () => {
  const marker = received("surface").at(-1);
  assert.equal(marker.header.frame_id, "disflow/object");
  assert.equal(marker.type, 11, "TRIANGLE_LIST");
  assert.equal(marker.colors.length, marker.points.length);
  assert.ok(triangles(marker).length > 500);
  const samples = points(received("cloud").at(-1));
  for (const [corner] of triangles(marker).filter((_, i) => i % 50 === 0)) {
    const gap = Math.min(...samples.map((s) => Math.hypot(s.x - corner.x, s.y - corner.y, s.z - corner.z)));
    assert.ok(gap < 0.02, `${gap} m from the nearest sample`);
  }
});

test("query_distance_field answers every point, and says which it cannot", () => {
  assert.equal(answered.success, true, answered.message);
  assert.equal(answered.model.frame_id, "disflow/object");
  for (const name of ["distance", "gradient", "variance", "in_bounds"]) {
    assert.equal(answered[name].length, asked.length + 1);
  }
  assert.ok(Number.isNaN(answered.distance.at(-1)) && !answered.in_bounds.at(-1));
  const right = asked.filter((_, i) => Math.abs(answered.distance[i] - 0.004) < 0.002);
  assert.ok(right.length > 0.9 * asked.length, `${right.length} of ${asked.length} distances`);
  const along = asked.filter((_, i) => {
    const { x, y, z } = answered.gradient[i];
    return dot([x, y, z], normal(samplesAsked[i])) > 0.9;
  });
  assert.ok(along.length > 0.9 * asked.length, `${along.length} of ${asked.length} gradients`);
  assert.ok(asked.every((_, i) => answered.variance[i] > 0));
});

test("query_distance_field refuses more than it can answer", () => {
  assert.equal(tooMuch.success, false);
  assert.match(tooMuch.message, /at most 2000/);
});

test("The run says what was sent", () => {
  assert.match(track.said, /dds:.*: \d+ messages sent, 0 failed, 0 results too late/);
});
