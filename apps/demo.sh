#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tracks a bottle and a box in front of a simulated depth camera and leaves everything in one folder.
# Usage: demo.sh BIN_DIR OUT_DIR
set -eu

if [ $# -ne 2 ]; then
  echo "usage: $0 BIN_DIR OUT_DIR" >&2
  exit 2
fi
bin=$1
out=$2
mkdir -p "$out"

# draw_mesh MESH.ply PICTURE.png: the surface from three sides, coloured by its standard deviation.
draw_mesh() {
  header=$(LC_ALL=C sed '/^end_header$/q' "$1")
  vertices=$(printf '%s\n' "$header" | LC_ALL=C sed -n 's/^element vertex //p')
  range=$(printf '%s\n' "$header" | LC_ALL=C sed -n 's/.*std_m from \([^ ]*\) .* to \([^ ]*\) .*/[\1 * 1e3:\2 * 1e3]/p')
  # The newline after end_header was cut by the shell.
  skip=$(($(printf '%s' "$header" | wc -c) + 1))
  gnuplot <<END
set terminal pngcairo size 1500,560 font "sans,12"
set output "$2"
set multiplot layout 1,3 title "Reconstructed surface, coloured by its standard deviation [mm]"
set palette defined (0 "#440154", 1 "#414487", 2 "#2a788e", 3 "#22a884", 4 "#7ad151", 5 "#fde725")
set cbrange $range
set size ratio -1
set style data points
set key off
set xlabel "[m]"
set xtics 0.05
mesh = '"$1" binary skip=$skip record=$vertices format="%float%float%float%float%float%float%uchar%uchar%uchar%float"'
set title "from the camera"
plot @mesh using (\$6 < 0 ? \$1 : NaN):(-\$2):(\$10 * 1e3) pointtype 7 pointsize 0.25 palette
set title "from the right"
plot @mesh using (\$4 > 0 ? \$3 : NaN):(-\$2):(\$10 * 1e3) pointtype 7 pointsize 0.25 palette
set title "from behind"
plot @mesh using (\$6 > 0 ? -\$1 : NaN):(-\$2):(\$10 * 1e3) pointtype 7 pointsize 0.25 palette
END
}

# add_to_page OBJECT: one section of the page with all pictures.
add_to_page() {
  {
    printf '<h2>%s</h2>\n<p><img src="%s/mesh.png" alt="surface"></p>\n<pre>\n' "$1" "$1"
    sed 's/&/\&amp;/g; s/</\&lt;/g' "$out/$1/metrics.txt"
    printf '</pre>\n'
    for picture in "$out/$1"/plots/*.png; do
      name=${picture##*/}
      printf '<p><img src="%s/plots/%s" alt="%s"></p>\n' "$1" "$name" "${name%.png}"
    done
  } >>"$page"
}

page=$out/summary.html
cat >"$page" <<'END'
<!doctype html>
<meta charset="utf-8">
<title>DisFlow Edge: demonstration</title>
<style>body { font-family: sans-serif; max-width: 75em; margin: auto } img { max-width: 100% }</style>
<h1>DisFlow Edge: two unknown objects, tracked and reconstructed</h1>
<p>A simulated D415-like depth camera (640 × 360, 30 frames/s) sees each object move at up to 0.6 m/s and 270 °/s.</p>
END

for object in bottle box; do
  folder=$out/$object
  mkdir -p "$folder"
  echo "== $object: simulating 300 frames"
  "$bin/disflow_sim" "$folder/sequence" --object "$object" --motion fast --noise d415 --seed 1 --frames 300 --force
  echo "== $object: tracking"
  "$bin/disflow_track" --sensor "replay:$folder/sequence" --csv "$folder/trajectory.csv" --mesh "$folder/mesh.ply"
  echo "== $object: evaluating"
  "$bin/disflow_eval" "$folder/sequence" --csv "$folder/trajectory.csv" --mesh "$folder/mesh.ply" \
    --json "$folder/metrics.json" --plots "$folder/plots" --summary "$folder/summary.md" | tee "$folder/metrics.txt"
  draw_mesh "$folder/mesh.ply" "$folder/mesh.png"
  add_to_page "$object"
done

echo
echo "Everything is in $out:"
echo "  summary.html                        one page with all pictures"
echo "  bottle/, box/: trajectory.csv       pose, twist and covariances of every frame"
echo "                 mesh.ply             surface, coloured by uncertainty (dark = certain)"
echo "                 plots/, summary.md   errors against the truth"
