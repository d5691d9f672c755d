// SPDX-License-Identifier: BSD-3-Clause
// A pitcher with a spout and a handle; mm.
$fn = 60;

module ring_of_the_handle(radius, lower_radius, width) {
  hull() {
    translate([-62, 0, 150]) rotate([90, 0, 0]) cylinder(r = radius, h = width, center = true);
    translate([-62, 0, 60]) rotate([90, 0, 0]) cylinder(r = lower_radius, h = width, center = true);
  }
}

difference() {
  union() {
    cylinder(r1 = 48, r2 = 58, h = 190);
    translate([0, 0, 175]) hull() {
      cylinder(r = 57, h = 14);
      translate([58, 0, 8]) cylinder(r = 12, h = 6);
    }
  }
  translate([0, 0, 6]) cylinder(r1 = 44, r2 = 54, h = 200);
  translate([0, 0, 178]) hull() {
    cylinder(r = 53, h = 30);
    translate([56, 0, 6]) cylinder(r = 8, h = 30);
  }
}
difference() {
  ring_of_the_handle(28, 24, 22);
  ring_of_the_handle(16, 12, 40);
  cylinder(r1 = 47, r2 = 57, h = 192);
}
