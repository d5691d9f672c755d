// SPDX-License-Identifier: BSD-3-Clause
// A toy brick: hollow from below, with studs; mm.
$fn = 30;

difference() {
  cube([128, 64, 76], center = true);
  translate([0, 0, -6]) cube([116, 52, 70], center = true);
}
for (x = [-1.5:1:1.5], y = [-0.5, 0.5]) translate([32 * x, 32 * y, 37]) cylinder(r = 10, h = 15);
