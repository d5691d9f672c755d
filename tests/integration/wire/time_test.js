// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// usage: node time_test.js DISFLOW.xml DISFLOW_TRACK...
// An autopilot whose clock is 1000 s ahead of this machine's, played by node-mavlink. A run sends its poses over four
// links, with the stamps of the images, of CLOCK_MONOTONIC, of the epoch and of that autopilot: of one frame they must be
// the same moment, within a millisecond. The autopilot asks for the time as well, and must learn the same clock.
const assert = require('assert');
const {spawn} = require('child_process');
const dgram = require('dgram');
const {common} = require('mavlink-mappings');
const {createMavLinkStream, MavLinkProtocolV2} = require('node-mavlink');
const {Readable} = require('stream');
const {loadDialect} = require('./mavlink');

const kAhead_ns = 1000n * 1000000000n;
const kAllowedMs = 1;
const kFrames = 90;
const kPatienceMs = 60000;
const kMs_ns = 1000000n;

const monotonic_ns = () => process.hrtime.bigint();
const autopilot_ns = () => monotonic_ns() + kAhead_ns;
/** Now since 1970; finer than Date.now(). */
const epochMs = () => performance.timeOrigin + performance.now();

/** One end of a link, as an autopilot has it. */
class Autopilot {
  constructor(dialect) {
    this.dialect = dialect;
    this.protocol = new MavLinkProtocolV2(1, 1);
    this.sequence = 0;
    this.stamps = [];       // of the poses, ms
    this.reset();
  }
  reset() {
    this.roundTrips = [];   // {rtt_ns, offset_ns}: the other clock minus this one
    this.systemTimes = [];
    this.questions = 0;
    this.names = new Set();
  }
  async open() {
    this.socket = dgram.createSocket('udp4');
    await new Promise((resolve) => this.socket.bind(0, '127.0.0.1', resolve));
    const input = new Readable({read() {}});
    createMavLinkStream(input, {magicNumbers: this.dialect.magicNumbers})
        .on('data', (packet) => this.take(packet));
    this.socket.on('message', (bytes, from) => {
      this.arrived_ns = autopilot_ns();
      this.from = from;
      input.push(bytes);
    });
  }
  send(message) {
    const bytes = this.protocol.serialize(message, this.sequence++ & 0xff);
    this.socket.send(bytes, this.from.port, this.from.address);
  }
  ask() {
    if (!this.from) return;
    const question = new common.TimeSync();
    question.tc1 = 0n;
    question.ts1 = autopilot_ns();
    this.send(question);
  }
  take(packet) {
    const clazz = Object.values(this.dialect.classes).find((one) => one.MSG_ID === packet.header.msgid);
    assert.ok(clazz, `message ${packet.header.msgid} is not defined`);
    assert.strictEqual(packet.header.sysid, 190);
    const message = packet.protocol.data(packet.payload, clazz);
    this.names.add(clazz.MSG_NAME);
    if (clazz === common.Odometry) this.stamps.push(Number(message.timeUsec) / 1000);
    if (clazz === common.SystemTime) this.systemTimes.push({message, epochMs: epochMs(), at_ns: monotonic_ns()});
    if (clazz === common.TimeSync) this.takeTime(message);
  }
  takeTime(message) {
    if (message.tc1 === 0n) {
      ++this.questions;
      const answer = new common.TimeSync();
      answer.tc1 = autopilot_ns();
      answer.ts1 = message.ts1;
      this.send(answer);
    } else {
      const rtt_ns = this.arrived_ns - message.ts1;
      this.roundTrips.push({rtt_ns, offset_ns: message.tc1 - (message.ts1 + rtt_ns / 2n)});
    }
  }
  /** The other clock minus this one by the quickest answer, ms, and by how much that may be wrong. */
  learnt() {
    const best = this.roundTrips.reduce((a, b) => a.rtt_ns < b.rtt_ns ? a : b);
    return {offsetMs: Number(best.offset_ns) / 1e6, boundMs: Number(best.rtt_ns) / 2e6};
  }
  close() {
    this.socket.close();
  }
}

function expectNear(actual, expected, allowed, what) {
  assert.ok(Math.abs(actual - expected) <= allowed, `${what}: ${actual}, expected ${expected} within ${allowed}`);
}

/** Frames are told by their capture stamps, which the first link carries: the n-th from the end is the n-th everywhere. */
function checkStamps(links) {
  const count = Math.min(...Object.values(links).map((link) => link.stamps.length));
  assert.ok(count >= kFrames / 2, `${count} poses on the autopilot's clock`);
  const last = (link) => link.stamps.slice(-count);
  const [capture, monotonic, epoch, autopilot] =
      [links.capture, links.monotonic, links.epoch, links.autopilot].map(last);
  const distanceMs = epochMs() - Number(monotonic_ns()) / 1e6;
  for (let i = 0; i < count; ++i) {
    expectNear(autopilot[i] - monotonic[i], Number(kAhead_ns) / 1e6, kAllowedMs, `frame ${i}, autopilot's clock`);
    expectNear(epoch[i] - monotonic[i], distanceMs, kAllowedMs, `frame ${i}, epoch`);
    if (i > 0) assert.ok(autopilot[i] > autopilot[i - 1], 'stamps must increase');
  }
  // A recording is played at its own pace: frame by frame the same time has passed.
  for (let i = 1; i < count; ++i)
    expectNear(monotonic[i] - monotonic[0], capture[i] - capture[0], 20, `frame ${i}, pace`);
  return count;
}

function checkClocks(links) {
  // What the autopilot learns is the clock of the stamps on that link, whichever it is.
  const expectedMs = {
    monotonic: -Number(kAhead_ns) / 1e6,
    epoch: epochMs() - Number(autopilot_ns()) / 1e6,
    autopilot: 0,
  };
  for (const [name, offsetMs] of Object.entries(expectedMs)) {
    const {offsetMs: actual, boundMs} = links[name].learnt();
    assert.ok(boundMs < 5, `${name}: quickest answer after ${2 * boundMs} ms`);
    expectNear(actual, offsetMs, kAllowedMs + boundMs, `clock of ${name}`);
  }
  for (const [name, link] of Object.entries(links)) {
    assert.strictEqual(link.questions > 0, name === 'autopilot', `${name} asks for the autopilot's clock`);
    assert.ok(link.systemTimes.length > 0);
    for (const {message, epochMs: nowMs, at_ns} of link.systemTimes) {
      expectNear(Number(message.timeUnixUsec) / 1000, nowMs, 1000, 'SYSTEM_TIME, epoch');
      expectNear(message.timeBootMs, Number((at_ns / kMs_ns) & 0xffffffffn), 1000, 'SYSTEM_TIME, boot');
    }
    for (const wanted of ['HEARTBEAT', 'ODOMETRY', 'DISFLOW_STATUS', 'SYSTEM_TIME'])
      assert.ok(link.names.has(wanted), `${name}: ${wanted}`);
  }
}

async function main() {
  const [xmlPath, ...track] = process.argv.slice(2);
  const dialect = await loadDialect(xmlPath);
  const links = {};
  const options = {capture: '', monotonic: '?stamps=monotonic', epoch: '?stamps=epoch', autopilot: '?stamps=autopilot'};
  for (const name of Object.keys(options)) {
    links[name] = new Autopilot(dialect);
    await links[name].open();
  }
  const uris = Object.entries(links).flatMap(
      ([name, link]) => ['--link', `udp://127.0.0.1:${link.socket.address().port}${options[name]}`]);
  setTimeout(() => {
    console.error(`no end after ${kPatienceMs} ms`);
    process.exit(1);
  }, kPatienceMs).unref();
  const child = spawn(track[0], [...track.slice(1), '--sensor', `sim:box?noise=clean&frames=${kFrames}`,
                                 '--rate', 'live', '--headless', ...uris],
                      {stdio: ['ignore', 'inherit', 'inherit']});
  const asking = setInterval(() => Object.values(links).forEach((link) => link.ask()), 20);
  const status = await new Promise((resolve) => child.on('exit', resolve));
  clearInterval(asking);
  assert.strictEqual(status, 0);
  const count = checkStamps(links);
  checkClocks(links);
  Object.values(links).forEach((link) => link.close());
  console.log(`stamps of ${count} frames agree on four clocks`);
}

main().then(() => process.exit(0), (error) => {
  console.error(error);
  process.exit(1);
});
