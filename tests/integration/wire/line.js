// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// Real lines to talk over: UDP and TCP on the loopback and a pair of pseudo-terminals by socat.
const {spawn} = require('child_process');
const dgram = require('dgram');
const fs = require('fs');
const net = require('net');
const os = require('os');
const path = require('path');
const tty = require('tty');

const delay = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

async function boundSocket() {
  const socket = dgram.createSocket('udp4');
  await new Promise((resolve) => socket.bind(0, '127.0.0.1', resolve));
  return socket;
}

/** @returns {Promise<{uri, onBytes, write, close}>} */
async function openUdp() {
  const socket = await boundSocket();
  const spare = await boundSocket();
  const peerPort = spare.address().port;
  await new Promise((resolve) => spare.close(resolve));
  return {
    uri: `udp://127.0.0.1:${socket.address().port}?bind=${peerPort}`,
    onBytes: (callback) => socket.on('message', callback),
    write: (bytes) => new Promise((resolve, reject) => socket.send(
        bytes, peerPort, '127.0.0.1', (error) => error ? reject(error) : resolve())),
    close: () => socket.close(),
  };
}

/** A port of the loopback that nobody has. */
async function freePort() {
  const server = net.createServer();
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const {port} = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

/** The far end is the server. */
async function openTcp() {
  let take;
  const connected = new Promise((resolve) => { take = resolve; });
  const server = net.createServer((socket) => {
    socket.setNoDelay(true).on('error', () => {});
    take(socket);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return {
    uri: `tcp://127.0.0.1:${server.address().port}?choose=yes`,
    onBytes: (callback) => connected.then((socket) => socket.on('data', callback)),
    write: async (bytes) => (await connected).write(bytes),
    close: () => {
      connected.then((socket) => socket.destroy());
      server.close();
    },
  };
}

/** The far end connects, again and again until somebody listens. */
async function openTcpListen() {
  const port = await freePort();
  let open = true;
  const connect = async () => {
    while (open) {
      const socket = net.connect({port, host: '127.0.0.1', noDelay: true});
      const ok = await new Promise((resolve) => socket.once('connect', () => resolve(true))
                                                      .once('error', () => resolve(false)));
      if (ok) return socket.on('error', () => {});
      await delay(5);
    }
    return undefined;
  };
  const connected = connect();
  return {
    uri: `tcp://127.0.0.1:${port}?listen=yes`,
    onBytes: (callback) => connected.then((socket) => socket.on('data', callback)),
    write: async (bytes) => (await connected).write(bytes),
    close: () => {
      open = false;
      connected.then((socket) => socket && socket.destroy());
    },
  };
}

async function openSerial() {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'disflow-wire-'));
  const [near, far] = ['near', 'far'].map((name) => path.join(folder, name));
  const socat = spawn('socat', [`pty,rawer,link=${near}`, `pty,rawer,link=${far}`],
                      {stdio: ['ignore', 'inherit', 'inherit']});
  for (let i = 0; i < 500 && !(fs.existsSync(near) && fs.existsSync(far)); ++i) await delay(10);
  const fd = fs.openSync(far, fs.constants.O_RDWR | fs.constants.O_NOCTTY);
  const stream = new tty.ReadStream(fd);
  stream.on('error', () => {});  // The line hangs up at the end of the test.
  return {
    uri: `serial://${near}?baud=115200`,
    onBytes: (callback) => stream.on('data', callback),
    write: async (bytes) => fs.writeSync(fd, bytes),
    close: () => {
      stream.destroy();
      socat.kill();
      fs.rmSync(folder, {recursive: true, force: true});
    },
  };
}

module.exports = {
  open: {udp: openUdp, tcp: openTcp, 'tcp-listen': openTcpListen, serial: openSerial},
  freePort,
};
