// SPDX-License-Identifier: BSD-3-Clause
// Services as a client of rmw_cyclonedds calls them, through the Fast DDS participant.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { decode, serviceOf, writerOf } from "./messages.js";
import { file } from "./program.js";

let asked = 0;

/** @param node With its namespace, e.g. "robot1/disflow". @returns What calls its services and gives the answer. */
export const caller = (peer, node) => async (kind, name, body) => {
  const [group, type] = kind.split("/");
  const definition = serviceOf(kind);
  const header = { client: 7n, seq: BigInt(++asked) };
  writeFileSync(file(`${name}_request`), writerOf(definition.request).writeMessage({ ...header, ...body }));
  const dds = `${group}::srv::dds_::${type}`;
  const answer = await peer.do(
    "call", `rq/${node}/${name}Request`, `${dds}_Request_`, `rr/${node}/${name}Reply`, `${dds}_Response_`, file(`${name}_request`),
    file(`${name}_reply`),
  );
  assert.equal(answer, "answered");
  const reply = decode(file(`${name}_reply`), definition.response).at(-1);
  assert.deepEqual([reply.client, reply.seq], [7n, BigInt(asked)]);
  return reply;
};
