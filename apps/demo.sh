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
  "$bin/disflow_track" --sensor "replay:$folder/sequence" --csv "$folder/trajectory.csv" --mesh "$folder/mesh.ply" \
    --mesh-picture "$folder/mesh.png"
  echo "== $object: evaluating"
  "$bin/disflow_eval" "$folder/sequence" --csv "$folder/trajectory.csv" --mesh "$folder/mesh.ply" \
    --json "$folder/metrics.json" --plots "$folder/plots" --summary "$folder/summary.md" | tee "$folder/metrics.txt"
  add_to_page "$object"
done

echo
echo "Everything is in $out:"
echo "  summary.html                        one page with all pictures"
echo "  bottle/, box/: trajectory.csv       pose, twist and covariances of every frame"
echo "                 mesh.ply             surface, coloured by uncertainty (dark = certain)"
echo "                 plots/, summary.md   errors against the truth"
