// SPDX-License-Identifier: BSD-3-Clause
// The object in three dimensions. All is in the camera's frame (x right, y down, z ahead), turned once so that up is up.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { geometryOf } from './surface.js';
import { cssColour, lineColours, onThemeChange } from './theme.js';

const kTrailPoints = 1800;
const kArrow_s = 0.08; // An arrow is as long as the way in this time.
const kDelay_s = 0.15; // Poses come in bundles; drawn so much later they move evenly.
// Drawn no oftener: a processor that has to draw by itself shall not be busy with it alone.
const kFrame_s = 1 / 35;
const kFrameByProcessor_s = 1 / 4;
const kSlow_s = 0.08;
const kCoarsest = 0.4; // Pixels drawn per pixel of the screen.

/** false: a program stands in for the graphics processor. */
function hasGraphicsProcessor() {
  return Boolean(document.createElement('canvas').getContext('webgl2', { failIfMajorPerformanceCaveat: true }));
}

export class Scene {
  /** Throws if the browser has no WebGL. */
  constructor(canvas) {
    this.canvas = canvas;
    const fast = hasGraphicsProcessor();
    this.frame_s = fast ? kFrame_s : kFrameByProcessor_s;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: fast });
    this.renderer.setPixelRatio(fast ? Math.min(devicePixelRatio, 2) : 0.5);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.01, 30);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.room = new THREE.Group();
    this.room.rotation.x = Math.PI;
    this.object = new THREE.Group();
    this.scene.add(this.room);
    this.room.add(this.object);
    this.follow = true;
    this.#addLights();
    this.#addSurface();
    this.#addLines();
    this.clear();
    onThemeChange(() => this.#applyTheme());
    this.#applyTheme();
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
    this.renderer.setAnimationLoop((now_ms) => this.#draw(now_ms / 1000));
  }

  #addLights() {
    const key = new THREE.DirectionalLight(0xffffff, 1.6);
    key.position.set(0.4, 0.8, 1);
    this.camera.add(key);
    this.scene.add(this.camera, new THREE.HemisphereLight(0xffffff, 0xc8d0d8, 1.7));
  }

  #addSurface() {
    const material = new THREE.MeshStandardMaterial({ vertexColors: true, side: THREE.DoubleSide, roughness: 0.75 });
    this.surface = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.axes = new THREE.AxesHelper(1);
    this.axes.material.depthTest = false;
    this.axes.renderOrder = 1;
    this.object.add(this.surface, this.axes);
  }

  #addLines() {
    const lines = (points, Kind = THREE.LineSegments) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * points), 3));
      const made = new Kind(geometry, new THREE.LineBasicMaterial());
      made.frustumCulled = false;
      return made;
    };
    this.arrows = lines(2 * 512);
    this.dots = new THREE.Points(this.arrows.geometry.clone(), new THREE.PointsMaterial({ size: 3, sizeAttenuation: false }));
    this.dots.frustumCulled = false;
    this.object.add(this.arrows, this.dots);
    this.trail = lines(kTrailPoints, THREE.Line);
    this.trail.material.vertexColors = this.trail.material.transparent = true;
    this.trail.geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(4 * kTrailPoints).fill(1), 4));
    this.arrows.material.transparent = true;
    this.arrows.material.opacity = 0.7;
    this.sensor = lines(16);
    const d = 0.08;
    const corners = [[-1.1, -0.65], [1.1, -0.65], [1.1, 0.65], [-1.1, 0.65]].map(([x, y]) => [x * d * 0.6, y * d * 0.6, d]);
    const edges = corners.flatMap((corner, i) => [[0, 0, 0], corner, corner, corners[(i + 1) % 4]]);
    this.sensor.geometry.attributes.position.array.set(edges.flat());
    this.room.add(this.trail, this.sensor);
  }

  #applyTheme() {
    this.scene.background = new THREE.Color(cssColour('--scene'));
    const [blue, orange] = lineColours();
    this.trail.material.color.set(blue);
    this.arrows.material.color.set(orange);
    this.dots.material.color.set(orange);
    this.sensor.material.color.set(cssColour('--quiet'));
  }

  /** Forgets all that was shown. */
  clear() {
    this.frames = [];
    this.shown_s = 0;
    this.trailCount = 0;
    this.placed = false;
    this.radius = 0.1;
    this.setSurface(null);
    for (const lines of [this.arrows, this.dots, this.trail]) lines.geometry.setDrawRange(0, 0);
    this.object.visible = false;
  }

  /** A refused frame has no pose: the object stays where it is. */
  addFrames(received) {
    const frames = received.filter((frame) => frame.position.every(Number.isFinite));
    if (frames.length === 0) return;
    for (const frame of frames) {
      if (frame.resetCounter !== this.resetCounter) this.trailCount = 0;
      this.resetCounter = frame.resetCounter;
      this.#appendToTrail(frame.position);
    }
    this.#fadeTrail();
    this.frames.push(...frames);
    if (this.frames.length > 120) this.frames.splice(0, this.frames.length - 120);
    this.object.visible = true;
  }

  #appendToTrail(position) {
    const attribute = this.trail.geometry.attributes.position;
    if (this.trailCount === kTrailPoints) {
      attribute.array.copyWithin(0, 3 * 300);
      this.trailCount -= 300;
    }
    attribute.array.set(position, 3 * this.trailCount);
    this.trailCount += 1;
    attribute.needsUpdate = true;
    this.trail.geometry.setDrawRange(0, this.trailCount);
  }

  /** What is long past is faint. */
  #fadeTrail() {
    const { color } = this.trail.geometry.attributes;
    for (let i = 0; i < this.trailCount; i += 1) color.setW(i, 0.08 + 0.92 * (1 - (this.trailCount - i) / kTrailPoints) ** 4);
    color.needsUpdate = true;
  }

  setSurface(surface) {
    this.surface.geometry.dispose();
    this.surface.geometry = surface ? geometryOf(surface) : new THREE.BufferGeometry();
    this.surface.visible = Boolean(surface && surface.indices.length > 0);
    if (!this.surface.visible) return;
    this.radius = Math.max(Math.hypot(...surface.size) / 2, 0.02);
    this.axes.scale.setScalar(0.9 * this.radius);
    if (!this.placed && this.frames.length > 0) this.home();
  }

  /** The samples are of a frame that may be past: they are hung onto the object where it was then. */
  setFlow(flow) {
    const frame = this.frames.find((candidate) => candidate.stamp === flow.stamp);
    if (!frame) return;
    const toObject = poseOf(frame).invert();
    const turn = new THREE.Quaternion().setFromRotationMatrix(toObject);
    const count = Math.min(flow.positions.length / 3, 512);
    const starts = this.dots.geometry.attributes.position;
    const ends = this.arrows.geometry.attributes.position;
    const start = new THREE.Vector3();
    const way = new THREE.Vector3();
    for (let i = 0; i < count; i += 1) {
      start.fromArray(flow.positions, 3 * i).applyMatrix4(toObject);
      way.fromArray(flow.flows, 3 * i).applyQuaternion(turn).multiplyScalar(kArrow_s);
      starts.setXYZ(i, start.x, start.y, start.z);
      ends.setXYZ(2 * i, start.x, start.y, start.z);
      ends.setXYZ(2 * i + 1, start.x + way.x, start.y + way.y, start.z + way.z);
    }
    starts.needsUpdate = true;
    ends.needsUpdate = true;
    this.dots.geometry.setDrawRange(0, count);
    this.arrows.geometry.setDrawRange(0, 2 * count);
  }

  show({ flow, trail, axes, follow }) {
    this.arrows.visible = flow;
    this.dots.visible = flow;
    this.trail.visible = trail;
    this.axes.visible = axes;
    this.follow = follow;
  }

  /** Looks at the object from beside the sensor. */
  home() {
    const target = this.#objectInScene();
    const towards = new THREE.Vector3(0.45, 0.4, 1).normalize();
    const distance = (this.camera.aspect < 1 ? 4.6 : 3.6) * this.radius;
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towards, distance);
    this.placed = true;
  }

  #objectInScene() {
    this.#placeObject(0);
    this.room.updateMatrixWorld(true);
    const center = this.surface.geometry.attributes.position ? boundsCentre(this.surface.geometry) : new THREE.Vector3();
    return this.object.localToWorld(center);
  }

  #placeObject(elapsed_s) {
    const newest = this.frames.at(-1);
    if (!newest) return;
    const wanted = newest.stamp - kDelay_s;
    this.shown_s += elapsed_s;
    // Slower or faster than the wall clock: follows what comes.
    if (Math.abs(this.shown_s - wanted) > 0.4) this.shown_s = wanted;
    this.shown_s += 0.05 * (wanted - this.shown_s);
    let after = this.frames.findIndex((frame) => frame.stamp >= this.shown_s);
    if (after < 0) after = this.frames.length - 1;
    const b = this.frames[after];
    const a = this.frames[Math.max(after - 1, 0)];
    const share = b.stamp > a.stamp ? Math.min(Math.max((this.shown_s - a.stamp) / (b.stamp - a.stamp), 0), 1) : 1;
    this.object.position.fromArray(a.position).lerp(new THREE.Vector3(...b.position), share);
    this.object.quaternion.fromArray(a.rotation).slerp(new THREE.Quaternion(...b.rotation), share);
  }

  #draw(now_s) {
    const gap_s = now_s - (this.called_s ?? now_s);
    this.called_s = now_s;
    this.#adaptTo(gap_s);
    if (now_s - this.drawn_s < this.frame_s) return;
    const elapsed_s = Math.min(now_s - (this.drawn_s ?? now_s), 0.2);
    this.drawn_s = now_s;
    const before = this.object.position.clone();
    this.#placeObject(elapsed_s);
    if (this.follow && this.placed) {
      const moved = this.object.position.clone().sub(before).applyQuaternion(this.room.quaternion);
      this.controls.target.add(moved);
      this.camera.position.add(moved);
    }
    this.controls.update();
    this.renderer.render(this.scene, this.camera);
  }

  /** Without a graphics processor the picture gets coarser before the page gets slow. */
  #adaptTo(gap_s) {
    this.gap_s = 0.9 * (this.gap_s ?? 0) + 0.1 * Math.min(gap_s, 1);
    if (this.gap_s < kSlow_s || this.renderer.getPixelRatio() <= kCoarsest) return;
    this.renderer.setPixelRatio(Math.max(kCoarsest, 0.7 * this.renderer.getPixelRatio()));
    this.gap_s = 0;
    this.#resize();
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
  }
}

function poseOf(frame) {
  return new THREE.Matrix4().compose(new THREE.Vector3(...frame.position), new THREE.Quaternion(...frame.rotation), new THREE.Vector3(1, 1, 1));
}

function boundsCentre(geometry) {
  geometry.computeBoundingBox();
  return geometry.boundingBox.getCenter(new THREE.Vector3());
}
