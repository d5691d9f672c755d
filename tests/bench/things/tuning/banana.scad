// SPDX-License-Identifier: BSD-3-Clause
// A banana: bent, five-sided, thinner towards its ends; mm.
bend_radius = 110;

function place(angle) = [bend_radius * sin(angle), 0, bend_radius * cos(angle) - bend_radius];
function thickness(angle) = 4 + 15 * pow(max(0, cos(1.9 * angle)), 0.6);
module slice(angle) {
  translate(place(angle)) rotate([0, angle, 0]) rotate([0, 90, 0]) cylinder(r = thickness(angle), h = 0.5, $fn = 5);
}

for (angle = [-46:4:42]) hull() {
  slice(angle);
  slice(angle + 4);
}
translate(place(46)) rotate([0, 46, 0]) rotate([0, 90, 0]) cylinder(r = 4, h = 16, $fn = 30);
