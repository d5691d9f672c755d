// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// usage: node wire_test.js udp|tcp|tcp-listen|serial send|receive|send-signed|receive-signed DISFLOW.xml WIRE_PEER...
//   send            DisFlow sends, node-mavlink decodes; every field and every byte must agree
//   receive         node-mavlink sends, with garbage, foreign and signed messages; DisFlow decodes
//   send-signed     as send; every signature must be the one that node-mavlink makes
//   receive-signed  node-mavlink sends signed messages and some that are not to be trusted
const assert = require('assert');
const {spawn} = require('child_process');
const path = require('path');
const readline = require('readline');
const {Readable} = require('stream');
const {common} = require('mavlink-mappings');
const {createMavLinkStream, MavLinkPacketSignature, MavLinkProtocolV2} = require('node-mavlink');
const lines = require('./line');
const {checkSignatures, KeyFile, signedTraffic} = require('./signing');
const {encode, loadDialect, toNative} = require('./mavlink');

const vectorsPath = path.join(__dirname, 'vectors.json');
const vectors = require(vectorsPath).messages;
const kPatienceMs = 15000;

const asFloat32 = (value) => Array.isArray(value) ? value.map(Math.fround) : Math.fround(value);

/** Compares decoded fields with a vector; `read` gives the value of a field. */
function expectFields(vector, fields, read) {
  for (const field of fields) {
    const expected = toNative(vector.fields[field.source], field.type);
    const isFloat = field.type.startsWith('float');
    assert.deepStrictEqual(isFloat ? asFloat32(read(field)) : read(field),
                           isFloat ? asFloat32(expected) : expected,
                           `${vector.message}.${field.source}`);
  }
}

function startPeer(peer, args) {
  const child = spawn(peer[0], [...peer.slice(1), ...args], {stdio: ['pipe', 'pipe', 'inherit']});
  const exited = new Promise((resolve) => child.on('exit', resolve));
  return {child, exited};
}

async function testSend(line, dialect, peer, key) {
  const input = new Readable({read() {}});
  const packets = [];
  const complete = new Promise((resolve) => {
    const settings = {magicNumbers: dialect.magicNumbers, key: key && key.bytes};
    createMavLinkStream(input, settings).on('data', (packet) => {
      packets.push(packet);
      if (packets.length === vectors.length) resolve();
    });
  });
  line.onBytes((bytes) => input.push(bytes));
  const {child, exited} = startPeer(peer, ['send', key ? key.uri(line) : line.uri, vectorsPath]);
  await Promise.race([complete, exited]);
  child.stdin.end();
  assert.strictEqual(await exited, 0, 'wire_peer failed');
  assert.strictEqual(packets.length, vectors.length, 'number of messages');

  vectors.forEach((vector, i) => {
    const packet = packets[i];
    const clazz = dialect.classes[vector.message];
    assert.strictEqual(packet.header.msgid, clazz.MSG_ID, vector.message);
    assert.strictEqual(packet.header.seq, vector.sequence);
    assert.strictEqual(packet.header.sysid, vector.system_id);
    assert.strictEqual(packet.header.compid, vector.component_id);
    const message = packet.protocol.data(packet.payload, clazz);
    expectFields(vector, clazz.FIELDS, (field) => message[field.name]);
    if (key) return;
    assert.strictEqual(packet.buffer.toString('hex'), encode(vector, dialect).toString('hex'),
                       `bytes of message ${i}, ${vector.message}`);
  });
  if (key) checkSignatures(packets, vectors, dialect, key);
}

/** What node sends: every vector, then a signed one, with things in between that are none. */
function traffic(dialect) {
  const foreign = new MavLinkProtocolV2(1, 1).serialize(new common.Attitude(), 0);
  const damaged = encode(vectors[0], dialect);
  damaged[12] ^= 0x40;
  const parts = [Buffer.from([0xfd, 0x00, 0xfd, 0xff, 0xfe]), foreign, damaged];
  for (const vector of vectors) {
    parts.push(encode(vector, dialect), Buffer.from([0x00, 0xfd]));
  }
  const unsigned = encode(vectors[1], dialect, MavLinkProtocolV2.IFLAG_SIGNED);
  const key = MavLinkPacketSignature.key('secret');
  parts.push(new MavLinkProtocolV2().sign(unsigned, 1, key));
  // Lets the last false start come to its end.
  parts.push(Buffer.alloc(16));
  return parts;
}

async function testReceive(line, dialect, peer, key) {
  const expected = key ? vectors.map((vector) => ({...vector, signed: true}))
                       : [...vectors.map((vector) => ({...vector, signed: false})),
                          {...vectors[1], signed: true}];
  const uri = key ? key.uri(line) : line.uri;
  const parts = key ? signedTraffic(vectors, dialect, key) : traffic(dialect);
  const {child, exited} = startPeer(peer, ['receive', uri, String(expected.length)]);
  const printed = [];
  for await (const text of readline.createInterface({input: child.stdout})) {
    printed.push(JSON.parse(text));
    if (printed.length > 1) continue;
    for (const part of parts) await line.write(part);
  }
  assert.strictEqual(await exited, 0, 'wire_peer failed');
  assert.strictEqual(printed.shift(), 'ready');
  const counters = printed.pop();
  if (key) {
    for (const what of ['without_signature', 'wrong_signature', 'replayed', 'outdated'])
      assert.ok(counters[what] >= 1, `${what} must be counted: ${JSON.stringify(counters)}`);
  } else {
    assert.ok(counters.unknown_id >= 1, 'the foreign message must be counted');
    assert.ok(counters.bad_checksum >= 1, 'the damaged message must be counted');
  }
  assert.strictEqual(printed.length, expected.length, 'number of messages');
  expected.forEach((vector, i) => {
    const got = printed[i];
    for (const name of ['message', 'sequence', 'system_id', 'component_id', 'signed']) {
      assert.strictEqual(got[name], vector[name], `message ${i}: ${name}`);
    }
    expectFields(vector, dialect.classes[vector.message].FIELDS,
                 (field) => toNative(got.fields[field.source], field.type));
  });
}

async function main() {
  const [kind, direction, xmlPath, ...peer] = process.argv.slice(2);
  const dialect = await loadDialect(xmlPath);
  const line = await lines.open[kind]();
  const [verb, how] = direction.split('-');
  const key = how === 'signed' ? new KeyFile() : undefined;
  setTimeout(() => {
    console.error(`no end after ${kPatienceMs} ms`);
    process.exit(1);
  }, kPatienceMs).unref();
  try {
    await (verb === 'send' ? testSend : testReceive)(line, dialect, peer, key);
  } finally {
    line.close();
    if (key) key.close();
  }
  console.log(`${kind} ${direction}: ${vectors.length} messages agree`);
}

main().then(() => process.exit(0), (error) => {
  console.error(error);
  process.exit(1);
});
