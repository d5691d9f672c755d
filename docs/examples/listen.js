// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// usage: node listen.js [PORT] [MESSAGES]
// Prints what disflow_track sends to a UDP port of this machine, decoded by node-mavlink (npm install node-mavlink), which knows
// nothing of DisFlow: everything here is a standard MAVLink message. Ends after so many messages of the object's pose.
const dgram = require('dgram');
const {Readable} = require('stream');
const {createMavLinkStream, common, minimal} = require('node-mavlink');

const port = Number(process.argv[2] ?? 14550);
let left = Number(process.argv[3] ?? 5);

const printers = {
  [minimal.Heartbeat.MSG_ID]: (data, header) => `HEARTBEAT of system ${header.sysid}, component ${header.compid}`,
  [common.Odometry.MSG_ID]: (data) => {
    left -= 1;
    return `ODOMETRY: the object is at ${metres(data.x)}, ${metres(data.y)}, ${metres(data.z)}, quality ${data.quality} %`;
  },
  [common.LandingTarget.MSG_ID]: (data) => {
    left -= 1;
    return `LANDING_TARGET: ${metres(data.distance)} away, at ${metres(data.x)}, ${metres(data.y)}, ${metres(data.z)}` +
        ` (frame ${data.frame}), ${degrees(data.angleX)} right, ${degrees(data.angleY)} down`;
  },
};
const registry = {
  [minimal.Heartbeat.MSG_ID]: minimal.Heartbeat,
  [common.Odometry.MSG_ID]: common.Odometry,
  [common.LandingTarget.MSG_ID]: common.LandingTarget,
};

function metres(value) { return `${value.toFixed(3)} m`; }
function degrees(radians) { return `${(radians * 180 / Math.PI).toFixed(1)}°`; }

const bytes = new Readable({read() {}});
createMavLinkStream(bytes).on('data', (packet) => {
  const kind = registry[packet.header.msgid];
  if (!kind || left <= 0) return;
  console.log(printers[packet.header.msgid](packet.protocol.data(packet.payload, kind), packet.header));
  if (left <= 0) process.exit(0);
});

const socket = dgram.createSocket('udp4');
socket.on('message', (datagram) => bytes.push(datagram));
socket.bind(port, '127.0.0.1', () => console.log(`listening on port ${port}`));
