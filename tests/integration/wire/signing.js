// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// Message signing as node-mavlink does it; nothing here knows DisFlow's.
const assert = require('assert');
const crypto = require('crypto');
const fs = require('fs');
const os = require('os');
const path = require('path');
const {MavLinkPacketSignature, MavLinkProtocolV2} = require('node-mavlink');
const {encode} = require('./mavlink');

const kLinkId = 3;  // as in wire_peer.cc
const kMinuteMs = 60000;
const kUnitsPerMs = 100;

/** A random key in a file of hex digits that nobody else may read. */
class KeyFile {
  constructor() {
    this.bytes = crypto.randomBytes(32);
    this.folder = fs.mkdtempSync(path.join(os.tmpdir(), 'disflow-key-'));
    this.path = path.join(this.folder, 'link.key');
    fs.writeFileSync(this.path, this.bytes.toString('hex') + '\n', {mode: 0o600});
  }
  uri(line) {
    return `${line.uri}&key=${this.path}`;
  }
  close() {
    fs.rmSync(this.folder, {recursive: true, force: true});
  }
}

const signingTime = (unixMs) => (unixMs - MavLinkProtocolV2.SIGNATURE_START_TIME) * kUnitsPerMs;

/** Every byte of what came must be what node-mavlink makes of the same message, time and key. */
function checkSignatures(packets, vectors, dialect, key) {
  let last = signingTime(Date.now() - kMinuteMs);
  packets.forEach((packet, i) => {
    const {signature} = packet;
    assert.ok(signature, `message ${i} must be signed`);
    assert.ok(signature.matches(key.bytes), `signature of message ${i}`);
    assert.strictEqual(signature.linkId, kLinkId);
    assert.ok(signature.timestamp > last, 'the time must increase');
    last = signature.timestamp;
    const expected = Buffer.concat([encode(vectors[i], dialect, MavLinkProtocolV2.IFLAG_SIGNED),
                                    Buffer.alloc(MavLinkPacketSignature.SIGNATURE_LENGTH)]);
    const made = new MavLinkPacketSignature(expected);
    made.linkId = kLinkId;
    made.timestamp = signature.timestamp;
    made.signature = made.calculate(key.bytes);
    assert.strictEqual(packet.buffer.toString('hex'), expected.toString('hex'), `message ${i}`);
  });
  assert.ok(last <= signingTime(Date.now() + kMinuteMs), 'the time must be that of the clock');
}

/** Every vector signed, and in between what must not be believed. */
function signedTraffic(vectors, dialect, key) {
  const start = Date.now();
  let sent = 0;
  const sign = (vector, bytes, unixMs) => new MavLinkProtocolV2().sign(
      encode(vector, dialect, MavLinkProtocolV2.IFLAG_SIGNED), 1, bytes, unixMs);
  const parts = [encode(vectors[0], dialect), sign(vectors[0], crypto.randomBytes(32), start),
                 sign(vectors[0], key.bytes, start - 2 * kMinuteMs)];
  for (const vector of vectors) {
    const genuine = sign(vector, key.bytes, start + ++sent);
    const changed = sign(vector, key.bytes, start + 10000);
    changed[changed.length - 1] ^= 0x10;
    parts.push(changed, genuine, genuine, encode(vector, dialect));
  }
  // The last genuine one ends the test.
  return parts.slice(0, -2);
}

module.exports = {checkSignatures, KeyFile, signedTraffic};
