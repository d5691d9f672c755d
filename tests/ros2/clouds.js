// SPDX-License-Identifier: BSD-3-Clause

/** The points of a sensor_msgs/PointCloud2 of floats, by the names of its fields. */
export function points(cloud) {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  return Array.from({ length: cloud.width * cloud.height }, (_, i) =>
    Object.fromEntries(
      cloud.fields.map(({ name, offset, datatype }) => {
        if (datatype !== 7) throw new Error(`${name} is no float`);
        return [name, view.getFloat32(i * cloud.point_step + offset, !cloud.is_bigendian)];
      }),
    ),
  );
}

/** The triangles of a visualization_msgs/Marker. */
export function triangles({ points: corners }) {
  return Array.from({ length: corners.length / 3 }, (_, i) => corners.slice(3 * i, 3 * i + 3));
}
