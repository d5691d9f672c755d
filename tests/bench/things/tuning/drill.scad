// SPDX-License-Identifier: BSD-3-Clause
// A cordless drill; mm.
use <../solids.scad>
$fn = 36;

// Motor, gear, chuck.
rotate([0, 90, 0]) hull() {
  translate([0, 0, -70]) cylinder(r = 26, h = 20);
  translate([0, 0, 40]) cylinder(r = 30, h = 10);
}
rotate([0, 90, 0]) translate([0, 0, 45]) cylinder(r1 = 28, r2 = 14, h = 25);
rotate([0, 90, 0]) translate([0, 0, 68]) cylinder(r1 = 13, r2 = 9, h = 28);
// Grip, battery, trigger.
hull() {
  translate([-35, 0, -20]) rounded_box([38, 34, 10], 4);
  translate([-48, 0, -105]) rounded_box([40, 36, 10], 4);
}
translate([-40, 0, -122]) rounded_box([95, 62, 36], 6);
translate([-8, 0, -36]) rounded_box([22, 14, 26], 4);
