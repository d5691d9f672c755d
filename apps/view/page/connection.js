// SPDX-License-Identifier: BSD-3-Clause
// The link to the server: comes back by itself after it was lost.
import { decode, encodeChoice, encodeCommand, encodeSetting } from './messages.js';

const kSilence_ms = 3000; // The server says something twice a second.
const kLongestWait_ms = 3000;

export class Connection {
  /** @param handlers {message(message), state('open' | 'lost' | 'refused' | 'full')} */
  constructor(handlers) {
    this.handlers = handlers;
    this.wait_ms = 250;
    this.heard_ms = 0;
    setInterval(() => this.#checkSilence(), 500);
    this.#connect();
  }

  send(name, object) {
    this.#send(encodeCommand(name, object));
  }

  choose(object, place) {
    this.#send(encodeChoice(object, place));
  }

  set(object, number, value) {
    this.#send(encodeSetting(object, number, value));
  }

  #send(bytes) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(bytes);
  }

  #connect() {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}/live`, 'disflow.v1');
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    this.heard_ms = performance.now();
    socket.onmessage = (event) => {
      if (socket !== this.socket) return;
      this.heard_ms = performance.now();
      const message = decode(event.data);
      if (message?.kind === 'hello') {
        this.wait_ms = 250;
        this.handlers.state('open');
      }
      if (message) this.handlers.message(message);
    };
    socket.onclose = () => {
      if (socket === this.socket) this.#lose();
    };
  }

  #checkSilence() {
    if (!this.socket || performance.now() - this.heard_ms < kSilence_ms) return;
    const socket = this.socket;
    this.#lose();
    socket.close();
  }

  async #lose() {
    this.socket = null;
    this.handlers.state('lost');
    setTimeout(() => this.#tryAgain(), this.wait_ms);
    this.wait_ms = Math.min(2 * this.wait_ms, kLongestWait_ms);
  }

  /** Asks by HTTP first: a page can see there why it is refused, and a try that fails is silent. */
  async #tryAgain() {
    const status = await fetch('/icon.svg', { cache: 'no-store' }).then((r) => r.status, () => 0);
    if (status === 200) {
      this.#connect();
      return;
    }
    if (status === 401) this.handlers.state('refused');
    setTimeout(() => this.#tryAgain(), this.wait_ms);
  }
}
