// SPDX-License-Identifier: BSD-3-Clause
// A hammer; mm.
use <../solids.scad>
$fn = 36;

// Handle.
hull() {
  translate([0, 0, -130]) rounded_box([30, 24, 20], 8);
  translate([0, 0, -60]) rounded_box([24, 18, 20], 8);
}
hull() {
  translate([0, 0, -60]) rounded_box([24, 18, 20], 8);
  translate([0, 0, 100]) rounded_box([20, 14, 10], 5);
}
// Head, face and peen.
translate([0, 0, 112]) {
  rotate([0, 90, 0]) cylinder(r = 13, h = 60, center = true);
  rotate([0, 90, 0]) translate([0, 0, 28]) cylinder(r = 17, h = 26);
  hull() {
    translate([-28, 0, 0]) rounded_box([12, 24, 24], 3);
    translate([-80, 0, -14]) rounded_box([6, 30, 3], 1.4);
  }
}
