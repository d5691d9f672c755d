// SPDX-License-Identifier: BSD-3-Clause
// A padlock; mm.
use <../solids.scad>
$fn = 40;

hull() {
  rounded_box([70, 26, 60], 6);
  translate([0, 0, -4]) rounded_box([74, 30, 46], 6);
}
// Shackle.
translate([0, 0, 28]) rotate([90, 0, 0]) difference() {
  hull() {
    translate([0, 30, 0]) cylinder(r = 30, h = 11, center = true);
    cube([60, 2, 11], center = true);
  }
  hull() {
    translate([0, 30, 0]) cylinder(r = 19, h = 30, center = true);
    translate([0, -3, 0]) cube([38, 2, 30], center = true);
  }
}
