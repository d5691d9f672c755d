// SPDX-License-Identifier: BSD-3-Clause
// A shoe that one can look into; mm.
use <../solids.scad>
$fn = 36;

// Sole.
hull() {
  translate([-85, 0, 0]) scale([1, 0.9, 0.45]) sphere(36);
  translate([55, 4, 0]) scale([1, 0.9, 0.35]) sphere(46);
  translate([95, 10, -1]) scale([1, 1, 0.5]) sphere(26);
}
difference() {
  hull() {
    translate([-86, 0, 15]) cylinder(r = 30, h = 10);
    translate([-88, 0, 72]) cylinder(r = 24, h = 4);
    translate([-30, 0, 66]) cylinder(r = 22, h = 4);
    translate([60, 4, 14]) scale([1, 0.9, 0.5]) sphere(38);
  }
  hull() {
    translate([-86, 0, 60]) cylinder(r = 19, h = 40);
    translate([-36, 0, 54]) cylinder(r = 17, h = 40);
  }
}
