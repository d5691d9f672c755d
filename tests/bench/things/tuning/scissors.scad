// SPDX-License-Identifier: BSD-3-Clause
// A pair of scissors, a little open; mm.
$fn = 30;

module eye(radius, height) { scale([1, 1.35, 1]) cylinder(r = radius, h = height, center = true); }

module half(side) {
  rotate([0, 0, 11 * side]) translate([0, 0, 2.5 * side]) {
    hull() {
      cylinder(r = 9, h = 5, center = true);
      translate([0, 95, 0]) cylinder(r = 1.5, h = 5, center = true);
    }
    hull() {
      cylinder(r = 9, h = 5, center = true);
      translate([-4 * side, -55, 0]) cylinder(r = 7, h = 8, center = true);
    }
    translate([-18 * side, -78, 0]) difference() {
      eye(25, 12);
      eye(17, 20);
    }
  }
}

half(1);
half(-1);
cylinder(r = 5, h = 14, center = true);
