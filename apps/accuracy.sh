#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tracks and evaluates the simulated sequences of docs/results.md, seeds 1 to 5, and prints their table.
# Usage: accuracy.sh BIN_DIR OUT_DIR
set -eu

if [ $# -ne 2 ]; then
  echo "usage: $0 BIN_DIR OUT_DIR" >&2
  exit 2
fi
bin=$1
out=$2
mkdir -p "$out"

# value FILE JSON_KEY [JSON_KEY]: one number of a metrics file.
value() {
  file=$1
  shift
  if [ $# -eq 2 ]; then
    sed -n "/\"$1\": {/,/}/s/.*\"$2\": \([-0-9.e+]*\).*/\1/p" "$file" | head -n 1
  else
    sed -n "s/.*\"$1\": \([-0-9.e+]*\).*/\1/p" "$file" | head -n 1
  fi
}

echo "| sequence | ADD-AUC % (worst seed) | ADD-S-AUC % | e_t mm | e_a ° | v cm/s | ω °/s | final drift | lost frames |"
echo "|---|---|---|---|---|---|---|---|---|"
# Object, motion, noise, further simulator options, mask set.
while read -r object motion noise options mask; do
  rows=$out/rows.txt
  : >"$rows"
  for seed in 1 2 3 4 5; do
    name=$object-$motion-$noise-$mask$(echo "$options" | tr -dc 'a-z0-9')-$seed
    words=$(echo "$options" | tr , ' ' | sed 's/^-$//')
    # shellcheck disable=SC2086 # the options are words
    "$bin/disflow_sim" "$out/sequence" --object "$object" --motion "$motion" --noise "$noise" --seed "$seed" --frames 300 \
      --mask gt,sloppy $words --force >/dev/null
    "$bin/disflow_track" --sensor "replay:$out/sequence?mask=$mask" --csv "$out/$name.csv" --headless >/dev/null 2>&1 || true
    "$bin/disflow_eval" "$out/sequence" --csv "$out/$name.csv" --json "$out/$name.json" >/dev/null
    f=$out/$name.json
    echo "$(value "$f" add_auc_percent) $(value "$f" add_s_auc_percent) $(value "$f" translation_m rmse) \
$(value "$f" rotation_deg rmse) $(value "$f" linear_velocity_mps rmse) $(value "$f" angular_velocity_degps rmse) \
$(value "$f" final_drift_m) $(value "$f" final_drift_deg) $(value "$f" lost)" >>"$rows"
  done
  label="$object, $motion, $noise"
  [ "$mask" = gt ] || label="$label, mask: $mask"
  [ "$options" = - ] || label="$label, $(echo "$options" | tr , ' ')"
  awk -v label="$label" '
    { n++; for (i = 1; i <= NF; i++) sum[i] += $i; if (n == 1 || $1 < worst) worst = $1 }
    END {
      printf "| %s | %.2f (%.2f) | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f mm %.2f° | %.0f |\n", label, sum[1] / n, worst,
        sum[2] / n, 1e3 * sum[3] / n, sum[4] / n, 1e2 * sum[5] / n, sum[6] / n, 1e3 * sum[7] / n, sum[8] / n, sum[9]
    }' "$rows"
done <<'END'
box fast clean - gt
bottle fast clean - gt
box fast d415 - gt
bottle fast d415 - gt
box rotate360 d415 - gt
bottle rotate360 d415 - gt
box flying d415 - gt
bottle flying d415 - gt
box fast d415 - sloppy
bottle fast d415 - sloppy
box fast d415 - none
bottle fast d415 - none
box fast d415 --occluder,arm gt
box fast d415 --drop,0.2 gt
box fast d415 --camera,moving gt
can fast d415 - gt
doughnut fast d415 - gt
END
rm -rf "$out/sequence" "$out/rows.txt"
