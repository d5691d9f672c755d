// SPDX-License-Identifier: BSD-3-Clause
// A gamepad: two grips, two sticks, a cross and four buttons; mm.
use <../solids.scad>
$fn = 30;

hull() {
  translate([0, 12, 0]) rounded_box([100, 50, 30], 10);
  translate([0, 18, 4]) rounded_box([120, 36, 22], 9);
}
for (side = [-1, 1]) {
  capsule([side * 52, 10, 0], [side * 70, -52, -8], 21, 14);
  translate([side * 24, -6, 12]) {
    cylinder(r = 9, h = 12);
    translate([0, 0, 12]) scale([1, 1, 0.4]) sphere(11);
  }
}
translate([-42, 22, 14]) {
  cube([26, 9, 7], center = true);
  cube([9, 26, 7], center = true);
}
for (angle = [0:90:270]) translate([42 + 10 * cos(angle), 22 + 10 * sin(angle), 14]) cylinder(r = 5, h = 5);
