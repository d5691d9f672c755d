// SPDX-License-Identifier: BSD-3-Clause
// A depth camera's driver as the tests need it: one image after the other, each when the one before was tracked.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { cameraInfo } from "./frames.js";
import { writerOf } from "./messages.js";
import { ddsType, file, patience, run, samplesOf, sleep } from "./program.js";

export const stampOf = (ns) => ({ sec: Number(ns / 1000000000n), nanosec: Number(ns % 1000000000n) });
/** The encoder's stamps have another name for it. */
export const headerOf = (ns) => ({
  stamp: { sec: stampOf(ns).sec, nsec: stampOf(ns).nanosec },
  frame_id: "camera_depth_optical_frame",
});

const info = writerOf("sensor_msgs/CameraInfo");

/** Again and again until it has worked: what a best-effort writer sends is lost until the other side knows it. */
export async function repeat(send, worked) {
  for (let i = 0; i < 100 * patience && !(await worked()); ++i) {
    await send();
    await sleep(100);
  }
}

export class Player {
  /**
   * What a test adds: sendImage(index), and sendRubbish(), something on the same topic that is no image.
   * @param name Of the node and the first part of all topics.
   */
  constructor({ peer, camera, name, qos, stamps }) {
    Object.assign(this, { peer, camera, name, qos, stamps, status: `rt/${name}/object/status` });
  }
  async publish(topic, type, qos, bytes) {
    writeFileSync(file("sample"), bytes);
    assert.equal(await this.peer.do("publish", "rt" + topic, ddsType(type), qos, file("sample")), "published");
  }
  infoTopic() {
    return `/${this.name}/depth/camera_info`;
  }
  infoMessage(i, change = {}) {
    return info.writeMessage({ ...cameraInfo(headerOf(this.stamps[i]), this.camera), ...change });
  }
  sendInfo(i, change = {}) {
    return this.publish(this.infoTopic(), "sensor_msgs/CameraInfo", this.qos, this.infoMessage(i, change));
  }
  /** Once, without anybody there: for those who come later. */
  async keepInfo(i) {
    writeFileSync(file("sample"), this.infoMessage(i));
    const words = ["keep", "rt" + this.infoTopic(), ddsType("sensor_msgs/CameraInfo"), "latched", file("sample")];
    assert.equal(await this.peer.do(...words), "kept");
  }
  async tracked(count) {
    return Number(await this.peer.do("count", this.status)) >= count;
  }
  /** Runs disflow_track, which has not heard anybody yet. */
  async run(...options) {
    await this.peer.do("subscribe", this.status, ddsType("diagnostic_msgs/DiagnosticArray"), "reliable", file(`${this.name.replaceAll("/", "_")}.status`));
    this.child = run(...options);
  }
  /** Runs disflow_track until it has its first image tracked. */
  async start(...options) {
    await this.run(...options);
    // It says what is wrong as long as it has no image: then it hears.
    await repeat(() => this.sendRubbish(), () => /0 x 0 pixels/.test(this.child.said()));
    await this.sendImage(0);
    await repeat(() => this.sendInfo(0), () => this.tracked(1));
  }
  async step(i) {
    const both = [() => this.sendImage(i), () => this.sendInfo(i)];
    // Drivers send them in either order.
    if (i % 2 === 0) both.reverse();
    for (const one of both) await one();
    await samplesOf(this.peer, this.status, i + 1);
    assert.ok(await this.tracked(i + 1), `frame ${i} has come and gone; ${this.child.said()}`);
  }
  stop() {
    this.child.kill("SIGTERM");
    return this.child.ended;
  }
  async play(...options) {
    await this.start(...options);
    for (let i = 1; i < this.stamps.length; ++i) await this.step(i);
    return this.stop();
  }
}
