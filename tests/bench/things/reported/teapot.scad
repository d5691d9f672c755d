// SPDX-License-Identifier: BSD-3-Clause
// A teapot; mm.
use <../solids.scad>
$fn = 40;

scale([1, 1, 0.8]) sphere(70);
translate([0, 0, -58]) cylinder(r = 46, h = 10);
// Lid.
translate([0, 0, 48]) cylinder(r1 = 40, r2 = 30, h = 12);
translate([0, 0, 66]) sphere(11);
// Spout and handle.
capsule([50, 0, -15], [105, 0, 42], 19, 9);
capsule([105, 0, 42], [118, 0, 50], 9, 8);
translate([-74, 0, 5]) rotate([90, 0, 0]) rotate_extrude() translate([34, 0]) circle(8);
