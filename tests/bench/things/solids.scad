// SPDX-License-Identifier: BSD-3-Clause
// Solids that several things are made of; mm.

// About the origin; with edges of this radius.
module rounded_box(size, radius) {
  hull() for (x = [-1, 1], y = [-1, 1], z = [-1, 1])
    translate([x * (size[0] / 2 - radius), y * (size[1] / 2 - radius), z * (size[2] / 2 - radius)])
      sphere(radius, $fn = 20);
}

module capsule(from, to, from_radius, to_radius) {
  hull() {
    translate(from) sphere(from_radius);
    translate(to) sphere(to_radius);
  }
}
