// SPDX-License-Identifier: BSD-3-Clause
// A spanner: one end open, one a ring; mm.
$fn = 40;

difference() {
  union() {
    hull() {
      translate([0, -90, 0]) cylinder(r = 11, h = 11, center = true);
      translate([0, 90, 0]) cylinder(r = 13, h = 11, center = true);
    }
    translate([0, 105, 0]) cylinder(r = 31, h = 15, center = true);
    translate([0, -100, 0]) cylinder(r = 24, h = 14, center = true);
  }
  translate([0, 125, 0]) rotate([0, 0, 15]) cube([28, 56, 40], center = true);
  translate([0, -100, 0]) cylinder(r = 14, h = 40, center = true, $fn = 6);
}
