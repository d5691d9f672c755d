// SPDX-License-Identifier: BSD-3-Clause
// Decoders and encoders of ROS 2 messages, from ROS's own definitions and by Foxglove's library.
import { readFileSync } from "node:fs";
import { parse } from "@foxglove/rosmsg";
import definitions from "@foxglove/rosmsg-msgs-common";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";

const humble = definitions.ros2humble;

/** Of ros_discovery_info, which tells nodes; ROS 2 Iron and later. */
export const graphEntry = `rmw_dds_common/Gid gid
rmw_dds_common/NodeEntitiesInfo[] node_entities_info_seq
================
MSG: rmw_dds_common/Gid
uint8[16] data
================
MSG: rmw_dds_common/NodeEntitiesInfo
string<=256 node_namespace
string<=256 node_name
rmw_dds_common/Gid[] reader_gid_seq
rmw_dds_common/Gid[] writer_gid_seq`;

/** All definitions that the root needs, the root first; `own` are looked at before ROS's. */
function withDependencies(root, own = {}) {
  const found = new Map([[root.name ?? "", root]]);
  for (const definition of found.values()) {
    for (const field of definition.definitions) {
      if (!field.isComplex || field.isConstant) continue;
      const name = field.type;
      if (name === "time" || name === "duration" || found.has(name)) continue;
      const needed = own[name] ?? humble[name];
      if (!needed) throw new Error(`no definition of ${name}`);
      found.set(name, needed);
    }
  }
  return [...found.values()];
}

/** Definitions by a ROS name as nav_msgs/Odometry, or by the text of a .msg file. */
function definitionsOf(message) {
  if (humble[message]) return withDependencies(humble[message]);
  const [root, ...own] = parse(message, { ros2: true, skipTypeFixup: true });
  return withDependencies(root, Object.fromEntries(own.map((one) => [one.name, one])));
}

export const readerOf = (message) => new MessageReader(definitionsOf(message));
export const writerOf = (message) => new MessageWriter(definitionsOf(message));

/** The samples of a file that the peer writes; one that is not whole yet is left out. */
export function samples(path) {
  const bytes = readFileSync(path);
  const list = [];
  for (let at = 0; at + 4 <= bytes.length; ) {
    const size = bytes.readUInt32LE(at);
    if (at + 4 + size > bytes.length) break;
    list.push(Uint8Array.from(bytes.subarray(at + 4, at + 4 + size)));
    at += 4 + size;
  }
  return list;
}

/** The samples of a file, decoded; each must be used up to its last byte. */
export function decode(path, message) {
  const reader = readerOf(message);
  return samples(path).map((bytes) => reader.readMessage(bytes));
}

const kServiceHeader = "uint64 client\nint64 seq\n";

/** Both parts of a .srv file, each with the header that rmw_cyclonedds puts before it. */
export function service(path) {
  const [request, response] = readFileSync(path, "utf8").split(/^---$/m);
  return { request: kServiceHeader + request, response: kServiceHeader + response };
}

/** Services of ROS's own, of which the library has the messages alone: request and response. */
const services = {
  "rcl_interfaces/GetParameters": ["string[] names", "rcl_interfaces/ParameterValue[] values"],
  "rcl_interfaces/GetParameterTypes": ["string[] names", "uint8[] types"],
  "rcl_interfaces/DescribeParameters": ["string[] names", "rcl_interfaces/ParameterDescriptor[] descriptors"],
  "rcl_interfaces/ListParameters": ["string[] prefixes\nuint64 depth", "rcl_interfaces/ListParametersResult result"],
  "rcl_interfaces/SetParameters": ["rcl_interfaces/Parameter[] parameters", "rcl_interfaces/SetParametersResult[] results"],
  "rcl_interfaces/SetParametersAtomically": ["rcl_interfaces/Parameter[] parameters", "rcl_interfaces/SetParametersResult result"],
  "lifecycle_msgs/GetState": ["uint8 structure_needs_at_least_one_member", "lifecycle_msgs/State current_state"],
  "lifecycle_msgs/ChangeState": ["lifecycle_msgs/Transition transition", "bool success"],
  "lifecycle_msgs/GetAvailableStates": [
    "uint8 structure_needs_at_least_one_member", "lifecycle_msgs/State[] available_states",
  ],
  "lifecycle_msgs/GetAvailableTransitions": [
    "uint8 structure_needs_at_least_one_member", "lifecycle_msgs/TransitionDescription[] available_transitions",
  ],
};

/** Both parts of a service by its ROS name, each with that header. */
export function serviceOf(name) {
  const [request, response] = services[name].map((part) => kServiceHeader + part);
  return { request, response };
}
