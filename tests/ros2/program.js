// SPDX-License-Identifier: BSD-3-Clause
// The program under test, and what all tests need to talk about its topics.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";

/**
 * Folder of the programs under test, and that of this machine's own, which they talk to; given on the command line.
 * DISFLOW_EMULATOR, with its options, starts those of another processor.
 */
export const bin = process.argv[2];
export const ownBin = process.argv[3] ?? bin;
const emulator = process.env.DISFLOW_EMULATOR?.split(" ") ?? [];
/** How many times as long things may take: under an emulator a frame takes about as much longer. */
export const patience = emulator.length > 0 ? 10 : 1;
/** A domain of this process alone, so that tests do not hear each other. */
export const domain = 20 + (process.pid % 80);

const folder = mkdtempSync(join(tmpdir(), "disflow-ros2-"));
export const file = (name) => join(folder, name);
const children = [];
const ends = [];
/** What a test file does at its end. Not by after(): hooks run in the order of their making, and what is killed below came first. */
export const atEnd = (work) => ends.push(work);
/** Ends with the tests, also with those that failed. */
export function owned(child) {
  children.push(child);
  return child;
}
after(async () => {
  try {
    for (const work of ends) await work();
  } finally {
    for (const child of children) child.kill("SIGKILL");
    rmSync(folder, { recursive: true });
  }
});

export function run(...options) {
  const [program, ...before] = [...emulator, join(bin, "disflow_track")];
  const child = owned(spawn(program, [...before, ...options], { stdio: ["ignore", "ignore", "pipe"] }));
  let said = "";
  child.stderr.on("data", (data) => (said += data));
  child.said = () => said;
  child.ended = new Promise((resolve) =>
    child.once("exit", (status, signal) => resolve({ status, said: signal ? `ended by ${signal}; it said: ${said}` : said })),
  );
  return child;
}

/** Runs to its end, which must be a good one. */
export async function finished(...options) {
  const { status, said } = await run(...options).ended;
  assert.equal(status, 0, said);
  return said;
}

export const ddsType = (type) => type.replace("/", "::msg::dds_::") + "_";
export const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Waits until it holds, ten seconds at most; the test says what it means that it does not. */
export async function until(holds) {
  for (let i = 0; i < 200 * patience && !(await holds()); ++i) await sleep(50);
}
/** Waits for so many samples. */
export const samplesOf = (peer, topic, count) => until(async () => Number(await peer.do("count", topic)) >= count);
