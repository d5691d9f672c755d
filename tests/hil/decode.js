// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// Prints what a file of bytes from a serial line holds, decoded by an independent implementation of
// MAVLink: one JSON line per message.
const fs = require('fs');
const path = require('path');
const wire = path.join(__dirname, '..', 'integration', 'wire');
const {createMavLinkStream} = require(path.join(wire, 'node_modules', 'node-mavlink'));
const {loadDialect} = require(path.join(wire, 'mavlink.js'));

async function main() {
  const dialect = await loadDialect(path.join(__dirname, '..', '..', 'docs', 'disflow.xml'));
  const byId = new Map(Object.values(dialect.classes).map((clazz) => [clazz.MSG_ID, clazz]));
  const packets = createMavLinkStream(fs.createReadStream(process.argv[2]),
                                      {magicNumbers: dialect.magicNumbers});
  for await (const packet of packets) {
    const clazz = byId.get(packet.header.msgid);
    if (!clazz) continue;
    const message = packet.protocol.data(packet.payload, clazz);
    const fields = Object.fromEntries(clazz.FIELDS.map(({name, source}) => [source, message[name]]));
    console.log(JSON.stringify({message: clazz.MSG_NAME, sequence: packet.header.seq, ...fields},
                               (key, value) => typeof value === 'bigint' ? Number(value) : value));
  }
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
