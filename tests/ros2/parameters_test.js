// SPDX-License-Identifier: BSD-3-Clause
// Settings as parameters, pause as life cycle, by the services that `ros2 param` and `ros2 lifecycle` call.
// Usage: node parameters_test.js BIN_FOLDER
import assert from "node:assert/strict";
import { join } from "node:path";
import { before, test } from "node:test";
import { caller } from "./calls.js";
import { decode } from "./messages.js";
import { Peer } from "./peer.js";
import { atEnd, ddsType, domain, file, ownBin, patience, run, samplesOf, sleep, until } from "./program.js";

const events = "rt/parameter_events";
const transitions = "rt/disflow/transition_event";
const status = "rt/disflow/box/status";
const kNotSet = 0;
const kInteger = 2;
const kDouble = 3;
const kNothing = {
  type: kNotSet, bool_value: false, integer_value: 0n, double_value: 0, string_value: "", byte_array_value: [], bool_array_value: [],
  integer_array_value: [], double_array_value: [], string_array_value: [],
};
const whole = (value) => ({ ...kNothing, type: kInteger, integer_value: BigInt(value) });
const double = (value) => ({ ...kNothing, type: kDouble, double_value: value });

let peer;
let child;

before(async () => {
  peer = await Peer.start(join(ownBin, "ros2_peer"), domain);
  await peer.do("subscribe", events, ddsType("rcl_interfaces/ParameterEvent"), "reliable", file("events"));
  await peer.do("subscribe", transitions, ddsType("lifecycle_msgs/TransitionEvent"), "reliable", file("transitions"));
  await peer.do("subscribe", status, ddsType("diagnostic_msgs/DiagnosticArray"), "reliable", file("status"));
  child = run(
    "--sensor", "sim:box?motion=moderate&width=320&height=180&noise=white", "--rate", "realtime", "--frames", "20000", "--headless",
    "--object", "name=box", "--link", `dds:domain=${domain}&interface=lo&peer=127.0.0.1&parameters=yes&lifecycle=yes`,
  );
  await samplesOf(peer, status, 3);
});
atEnd(async () => {
  child.kill("SIGTERM");
  const { status: exit, said } = await child.ended;
  await peer.stop();
  assert.equal(exit, 0, said);
});

const call = (...what) => caller(peer, "disflow")(...what);
const get = async (...names) => (await call("rcl_interfaces/GetParameters", "get_parameters", { names })).values;
const set = async (...parameters) => (await call("rcl_interfaces/SetParameters", "set_parameters", { parameters })).results;
const list = async (prefixes, depth) =>
  (await call("rcl_interfaces/ListParameters", "list_parameters", { prefixes, depth: BigInt(depth) })).result;

test("all settings are listed, by prefix and depth too", async () => {
  const all = await list([], 0);
  assert.ok(all.names.length > 70);
  assert.ok(all.names.includes("box.registration.iterations"));
  assert.deepEqual(all.prefixes, ["box.field", "box.monitor", "box.registration", "box.sampler", "box.segmenter", "box.twist"]);
  assert.deepEqual((await list(["box.twist"], 0)).names, ["box.twist.angular_jerk_psd", "box.twist.linear_jerk_psd"]);
  assert.deepEqual((await list(["box.twi"], 0)).names, []);
  assert.deepEqual((await list([], 2)).names, []);
});

test("a parameter is described, read, and read as not set if there is none", async () => {
  const names = ["box.registration.iterations", "box.field.cell_size_m", "nothing"];
  const [iterations, cell, nothing] = (await call("rcl_interfaces/DescribeParameters", "describe_parameters", { names })).descriptors;
  assert.equal(iterations.type, kInteger);
  assert.equal(iterations.read_only, false);
  assert.deepEqual(iterations.integer_range, [{ from_value: 1n, to_value: 50n, step: 1n }]);
  assert.equal(cell.type, kDouble);
  assert.equal(cell.read_only, true);
  assert.match(cell.description, /octree leaf \(m\)/);
  assert.deepEqual(cell.floating_point_range, [{ from_value: 0.001, to_value: 2, step: 0 }]);
  assert.equal(nothing.type, kNotSet);
  const types = (await call("rcl_interfaces/GetParameterTypes", "get_parameter_types", { names })).types;
  assert.deepEqual([...types], [kInteger, kDouble, kNotSet]);
  const values = await get(...names);
  assert.equal(values[0].integer_value, 8n);
  assert.ok(Math.abs(values[1].double_value - 0.02) < 1e-6);
  assert.equal(values[2].type, kNotSet);
});

test("a parameter that is set holds from the next frame on, and the event tells it", async () => {
  assert.deepEqual(await set({ name: "box.monitor.degraded_std_m", value: whole(0) }), [{ successful: true, reason: "" }]);
  assert.equal((await get("box.monitor.degraded_std_m"))[0].double_value, 0);
  const messageNow = () => decode(file("status"), "diagnostic_msgs/DiagnosticArray").at(-1).status[0].message;
  await until(() => /degraded/.test(messageNow()));
  assert.match(messageNow(), /degraded/);
  await samplesOf(peer, events, 1);
  const event = decode(file("events"), "rcl_interfaces/ParameterEvent").at(-1);
  assert.equal(event.node, "/disflow");
  assert.equal(event.changed_parameters.length, 1);
  assert.equal(event.changed_parameters[0].name, "box.monitor.degraded_std_m");
  assert.equal(event.changed_parameters[0].value.double_value, 0);
});

test("what cannot be is refused in words, one by one or all together", async () => {
  const results = await set(
    { name: "box.registration.iterations", value: whole(12) },
    { name: "box.registration.iterations", value: whole(99) },
    { name: "box.registration.iterations", value: double(NaN) },
    { name: "box.registration.iterations", value: { ...kNothing, type: 4, string_value: "many" } },
    { name: "box.field.cell_size_m", value: double(0.05) },
    { name: "box.segmenter.min_range_m", value: double(50) },
    { name: "nothing", value: whole(1) },
  );
  assert.deepEqual(results.map(({ successful }) => successful), [true, false, false, false, false, false, false]);
  assert.match(results[1].reason, /from 1 to 50/);
  assert.match(results[4].reason, /may not change while the program runs/);
  assert.match(results[5].reason, /max_range_m does not fit/);
  assert.match(results[6].reason, /no parameter nothing/);
  assert.equal((await get("box.registration.iterations"))[0].integer_value, 12n);
  const atOnce = async (...parameters) =>
    (await call("rcl_interfaces/SetParametersAtomically", "set_parameters_atomically", { parameters })).result;
  const refused = await atOnce({ name: "box.registration.iterations", value: whole(20) }, { name: "nothing", value: whole(1) });
  assert.equal(refused.successful, false);
  assert.equal((await get("box.registration.iterations"))[0].integer_value, 12n);
  // Neither could be set before the other.
  const together = await atOnce(
    { name: "box.segmenter.min_range_m", value: double(0.2) }, { name: "box.registration.iterations", value: whole(20) },
  );
  assert.deepEqual(together, { successful: true, reason: "" });
  assert.equal((await get("box.registration.iterations"))[0].integer_value, 20n);
});

const stateNow = async () => {
  const { id, label } = (await call("lifecycle_msgs/GetState", "get_state", { structure_needs_at_least_one_member: 0 })).current_state;
  return [id, label];
};
const change = async (transition) => (await call("lifecycle_msgs/ChangeState", "change_state", { transition })).success;

test("the life cycle pauses and resumes, and refuses what there is not", async () => {
  assert.deepEqual(await stateNow(), [3, "active"]);
  assert.equal(await change({ id: 3, label: "" }), false);
  assert.equal(await change({ id: 1, label: "configure" }), false);
  assert.equal(await change({ id: 4, label: "" }), true);
  assert.deepEqual(await stateNow(), [2, "inactive"]);
  const empty = { structure_needs_at_least_one_member: 0 };
  const { available_transitions } = await call("lifecycle_msgs/GetAvailableTransitions", "get_available_transitions", empty);
  assert.deepEqual(available_transitions.map(({ transition, goal_state }) => [transition.label, goal_state.label]), [["activate", "active"]]);
  const { available_states } = await call("lifecycle_msgs/GetAvailableStates", "get_available_states", empty);
  assert.deepEqual(available_states.map(({ label }) => label), ["inactive", "active"]);
  await sleep(300 * patience);
  const paused = Number(await peer.do("count", status));
  await sleep(500 * patience);
  assert.equal(Number(await peer.do("count", status)), paused);
  assert.equal(await change({ id: 0, label: "activate" }), true);
  await samplesOf(peer, status, paused + 3);
  assert.deepEqual(await stateNow(), [3, "active"]);
  await samplesOf(peer, transitions, 2);
  const told = decode(file("transitions"), "lifecycle_msgs/TransitionEvent");
  assert.deepEqual(told.map(({ transition, start_state, goal_state }) => [transition, start_state, goal_state]), [
    [{ id: 4, label: "deactivate" }, { id: 3, label: "active" }, { id: 2, label: "inactive" }],
    [{ id: 3, label: "activate" }, { id: 2, label: "inactive" }, { id: 3, label: "active" }],
  ]);
  assert.ok(told[0].timestamp < told[1].timestamp && Math.abs(Number(told[1].timestamp) / 1e6 - Date.now()) < 60000);
});
