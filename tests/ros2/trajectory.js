// SPDX-License-Identifier: BSD-3-Clause
// The rows of a trajectory CSV as objects.
import { readFileSync } from "node:fs";

export function trajectory(path) {
  const [head, ...rows] = readFileSync(path, "utf8").trimEnd().split("\n");
  const names = head.split(",");
  return rows.map((row) => {
    const values = row.split(",");
    return Object.fromEntries(names.map((name, i) => [name, values[i]]));
  });
}

/** Nanoseconds of the column timestamp, exactly. */
export function stampNs(row) {
  return BigInt(row.timestamp.replace(".", ""));
}

/** What nine digits in the file stood for: a float. */
export const float = (text) => Math.fround(Number(text));

/** A 6 x 6 matrix from its upper triangle in the file, row by row. */
export function covariance(row, name) {
  const full = new Array(36);
  let k = 0;
  for (let i = 0; i < 6; ++i) {
    for (let j = i; j < 6; ++j) full[6 * i + j] = full[6 * j + i] = float(row[`cov_${name}_${k++}`]);
  }
  return full;
}
