// SPDX-License-Identifier: BSD-3-Clause
// A toy airplane: thin wings on a round body; mm.
use <../solids.scad>
$fn = 36;

capsule([-80, 0, 0], [50, 0, 0], 12, 20);
capsule([50, 0, 0], [78, 0, 0], 20, 14);
for (side = [-1, 1]) {
  hull() {
    translate([15, 0, -6]) rounded_box([48, 20, 8], 3.5);
    translate([0, side * 105, -2]) rounded_box([26, 8, 6], 2.8);
  }
  hull() {
    translate([-78, 0, 2]) rounded_box([24, 12, 6], 2.5);
    translate([-84, side * 42, 4]) rounded_box([14, 6, 5], 2.2);
  }
  translate([22, side * 45, -10]) rotate([0, 90, 0]) cylinder(r = 9, h = 34, center = true);
}
// Fin.
hull() {
  translate([-78, 0, 6]) rounded_box([26, 7, 8], 3);
  translate([-90, 0, 48]) rounded_box([14, 6, 6], 2.5);
}
