// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// usage: node time_test.js udp|tcp|tcp-listen|serial DISFLOW.xml DISFLOW_TRACK...
// An autopilot whose clock is 1000 s ahead of this machine's, played by node-mavlink. A run sends its poses over four
// links, with the stamps of the images, of CLOCK_MONOTONIC, of the epoch and of that autopilot: of one frame they must be
// the same moment, within a millisecond. The autopilot asks for the time as well, and must learn the same clock. Goes on
// until that holds: on a busy machine a quick answer takes its time.
const assert = require('assert');
const {spawn} = require('child_process');
const {common} = require('mavlink-mappings');
const {createMavLinkStream, MavLinkProtocolV2} = require('node-mavlink');
const {Readable} = require('stream');
const lines = require('./line');
const {loadDialect} = require('./mavlink');

const kAhead_ns = 1000n * 1000000000n;
const kAllowedMs = 1;
const kFrames = 30;  // in a row
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
    this.stamps = new Map();  // ms, by the number of the frame
    this.pose_usec = undefined;
    this.roundTrips = [];   // {rtt_ns, offset_ns}: the other clock minus this one
    this.systemTimes = [];
    this.questions = 0;
    this.names = new Set();
  }
  async open(kind) {
    this.line = await lines.open[kind]();
    const input = new Readable({read() {}});
    createMavLinkStream(input, {magicNumbers: this.dialect.magicNumbers})
        .on('data', (packet) => this.take(packet));
    this.line.onBytes((bytes) => {
      this.arrived_ns = autopilot_ns();
      input.push(bytes);
    });
  }
  send(message) {
    this.line.write(this.protocol.serialize(message, this.sequence++ & 0xff));
  }
  ask() {
    if (!this.arrived_ns) return;  // nobody is there yet
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
    if (clazz === common.Odometry) this.pose_usec = message.timeUsec;
    if (clazz.MSG_NAME === 'DISFLOW_STATUS') this.takeStatus(message);
    if (clazz === common.SystemTime) this.systemTimes.push({message, epochMs: epochMs(), at_ns: monotonic_ns()});
    if (clazz === common.TimeSync) this.takeTime(message);
  }
  takeStatus(message) {
    if (message.timeUsec !== this.pose_usec) return;  // that pose was lost on the way
    const newest = [...this.stamps.values()].at(-1);
    this.wentBack = this.wentBack || Number(message.timeUsec) / 1000 <= newest;
    this.stamps.set(message.frames, Number(message.timeUsec) / 1000);
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
    assert.ok(this.roundTrips.length > 0, 'questions for the time are answered');
    const best = this.roundTrips.reduce((a, b) => a.rtt_ns < b.rtt_ns ? a : b);
    return {offsetMs: Number(best.offset_ns) / 1e6, boundMs: Number(best.rtt_ns) / 2e6};
  }
  close() {
    this.line.close();
  }
}

function expectNear(actual, expected, allowed, what) {
  assert.ok(Math.abs(actual - expected) <= allowed, `${what}: ${actual}, expected ${expected} within ${allowed}`);
}

/** The newest frames that all links have told of. */
function checkStamps({capture, monotonic, epoch, autopilot}) {
  const distanceMs = epochMs() - Number(monotonic_ns()) / 1e6;
  const frames = [...autopilot.stamps.keys()].slice(-kFrames);
  assert.strictEqual(frames.length, kFrames, 'poses on the autopilot\'s clock');
  const first = frames[0];
  for (const i of frames) {
    const onMonotonic = monotonic.stamps.get(i);
    expectNear(autopilot.stamps.get(i) - onMonotonic, Number(kAhead_ns) / 1e6, kAllowedMs, `frame ${i}, autopilot`);
    expectNear(epoch.stamps.get(i) - onMonotonic, distanceMs, kAllowedMs, `frame ${i}, epoch`);
    // A recording is played at its own pace: frame by frame the same time has passed.
    expectNear(onMonotonic - monotonic.stamps.get(first), capture.stamps.get(i) - capture.stamps.get(first), kAllowedMs,
               `frame ${i}, pace`);
  }
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
    assert.ok(!link.wentBack, `${name}: stamps must increase`);
    assert.ok(link.systemTimes.length > 0, 'SYSTEM_TIME');
    for (const {message, epochMs: nowMs, at_ns} of link.systemTimes) {
      expectNear(Number(message.timeUnixUsec) / 1000, nowMs, 1000, 'SYSTEM_TIME, epoch');
      expectNear(message.timeBootMs, Number((at_ns / kMs_ns) & 0xffffffffn), 1000, 'SYSTEM_TIME, boot');
    }
    for (const wanted of ['HEARTBEAT', 'ODOMETRY', 'DISFLOW_STATUS', 'SYSTEM_TIME'])
      assert.ok(link.names.has(wanted), `${name}: ${wanted}`);
  }
}

async function main() {
  const [kind, xmlPath, ...track] = process.argv.slice(2);
  const dialect = await loadDialect(xmlPath);
  const links = {};
  const options = {capture: '', monotonic: '&stamps=monotonic', epoch: '&stamps=epoch', autopilot: '&stamps=autopilot'};
  for (const name of Object.keys(options)) {
    links[name] = new Autopilot(dialect);
    await links[name].open(kind);
  }
  const uris = Object.entries(links).flatMap(([name, {line}]) => ['--link', line.uri + options[name]]);
  const child = spawn(track[0], [...track.slice(1), '--sensor', 'sim:box?noise=clean&frames=100000', '--rate', 'live',
                                 '--headless', ...uris],
                      {stdio: ['ignore', 'inherit', 'inherit']});
  let running = true;
  const exited = new Promise((resolve) => child.on('exit', resolve)).finally(() => { running = false; });
  const asking = setInterval(() => Object.values(links).forEach((link) => link.ask()), 20);
  const deadline = Date.now() + kPatienceMs;
  let missing;
  do {
    await new Promise((resolve) => setTimeout(resolve, 100));
    missing = undefined;
    try {
      checkStamps(links);
      checkClocks(links);
    } catch (error) {
      missing = error;
    }
  } while (missing && running && Date.now() < deadline);
  clearInterval(asking);
  child.kill('SIGTERM');
  const status = await exited;
  Object.values(links).forEach((link) => link.close());
  if (missing) throw missing;
  assert.strictEqual(status, 0);
  console.log(`${kind}: stamps of ${kFrames} frames agree on four clocks`);
}

main().then(() => process.exit(0), (error) => {
  console.error(error);
  process.exit(1);
});
