// SPDX-License-Identifier: BSD-3-Clause
// The Fast DDS participant as a test sees it; its commands are explained in peer.cc.
import { spawn } from "node:child_process";
import { createInterface } from "node:readline";
import { owned } from "./program.js";

export class Peer {
  static async start(program, domain) {
    const peer = new Peer();
    peer.process = owned(spawn(program, [String(domain)], { stdio: ["pipe", "pipe", "inherit"] }));
    peer.lines = createInterface({ input: peer.process.stdout })[Symbol.asyncIterator]();
    await peer.answer();
    return peer;
  }
  async answer() {
    const { value, done } = await this.lines.next();
    if (done) throw new Error("the peer has ended");
    return value;
  }
  async do(...words) {
    this.process.stdin.write(words.join(" ") + "\n");
    return this.answer();
  }
  stop() {
    const ended = new Promise((resolve) => this.process.once("exit", resolve));
    this.process.stdin.end();
    return ended;
  }
}
