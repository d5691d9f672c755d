// SPDX-License-Identifier: BSD-3-Clause
// What really moved in a simulated run, and what its CSV says.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

const program = (name) => join(dirname(process.env.DISFLOW_TRACK), name);
/** A row that anything can be aligned with. */
const kAnyRow = 'frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n0,1,0,0,1,0,0,0,1,0,0,0,0,0,0\n';

/** The truth of a simulation by its address: {camera, poses: {name: [{position, rotation}]}}; rotation by rows. */
export function truthOf(folder, address, size, names) {
  execFileSync(program('disflow_sim'), ['--frames', '1', '--width', size.width, '--height', size.height, join(folder, 'one')]);
  const camera = JSON.parse(readFileSync(join(folder, 'one', 'cam_K.json'), 'utf8'));
  const csv = join(folder, 'any.csv');
  const tum = join(folder, 'truth.txt');
  writeFileSync(csv, kAnyRow);
  const poses = {};
  for (const name of names) {
    execFileSync(program('disflow_eval'), [address, '--csv', csv, '--object', name, '--tum-truth', tum]);
    poses[name] = readPoses(tum);
  }
  return { camera, poses };
}

const readPoses = (path) => readFileSync(path, 'utf8').trimEnd().split('\n').filter((line) => !line.startsWith('#')).map((line) => {
  const [, x, y, z, ...q] = line.split(' ').map(Number);
  return { position: [x, y, z], rotation: matrixOf(q) };
});

/** Where a point of the camera's frame lies in the picture, as shares of its sides. */
export function placeOf([x, y, z], { width, height, fx, fy, cx, cy }) {
  return { u: ((fx * x) / z + cx) / width, v: ((fy * y) / z + cy) / height };
}

export function rowsOf(path) {
  const [head, ...rows] = readFileSync(path, 'utf8').trimEnd().split('\n');
  const names = head.split(',');
  return rows.map((row) => Object.fromEntries(row.split(',').map((value, i) => [names[i], value])));
}

export const poseOf = (row) => ({
  position: [row.x, row.y, row.z].map(Number),
  rotation: matrixOf([row.qx, row.qy, row.qz, row.qw].map(Number)),
});

function matrixOf([x, y, z, w]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
  ];
}

const times = (a, b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, value, k) => sum + value * b[k][j], 0)));
const transposed = (a) => a[0].map((_, j) => a.map((row) => row[j]));
const turned = (a, x) => a.map((row) => row.reduce((sum, value, k) => sum + value * x[k], 0));
const minus = (a, b) => a.map((value, i) => value - b[i]);
export const length = (x) => Math.hypot(...x);
export const distance = (a, b) => length(minus(a, b));

/** What a body did between two poses, camera frame: rotation, and where a point that was at x is afterwards. */
function motion(from, to) {
  const rotation = times(to.rotation, transposed(from.rotation));
  return { rotation, move: (x) => turned(rotation, minus(x, from.position)).map((value, i) => value + to.position[i]) };
}

/** How far the motion between two poses is off the truth: m at the object, and degrees. */
export function errorOf([from, to], [trueFrom, trueTo]) {
  const said = motion(from, to);
  const truth = motion(trueFrom, trueTo);
  const off = times(said.rotation, transposed(truth.rotation));
  const cosine = (off[0][0] + off[1][1] + off[2][2] - 1) / 2;
  return {
    position_m: distance(said.move(from.position), truth.move(from.position)),
    angle_deg: (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI,
  };
}
