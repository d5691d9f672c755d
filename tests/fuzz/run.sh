#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs every fuzzer for a while, two at a time: tests/fuzz/run.sh BIN_FOLDER SECONDS
# What is found lies in BIN_FOLDER/../found afterwards, and the exit status is 1.
set -euo pipefail
bin="$(realpath "$1")"
seconds="$2"
corpus="$(realpath "$(dirname "${BASH_SOURCE[0]}")/corpus")"
found="$bin/../found"
mkdir -p "$found" "$bin/../grown" "$bin/../log"

# Seconds by the clock that one input may take. Half a second's work has taken 11 on a machine with other things to do.
most_s=60

run_one() {
  local name="$1" grown="$bin/../grown/$1" status=0
  mkdir -p "$grown"
  "$bin/$name" -max_total_time="$seconds" -max_len=4096 -rss_limit_mb=2048 -timeout="$most_s" -verbosity=0 -print_final_stats=1 \
    -artifact_prefix="$found/$name-" "$grown" "$corpus/$name" >"$bin/../log/$name.txt" 2>&1 || status=$?
  printf '%s: %s inputs%s\n' "$name" "$(sed -n 's/stat::number_of_executed_units: *//p' "$bin/../log/$name.txt")" \
    "$([ $status -eq 0 ] || echo ", FAULT, see $bin/../log/$name.txt")"
  return $status
}

failed=0
names=()
for program in "$bin"/fuzz_*; do names+=("$(basename "$program")"); done
for ((i = 0; i < ${#names[@]}; i += 2)); do
  pids=()
  for name in "${names[@]:i:2}"; do
    run_one "$name" &
    pids+=($!)
  done
  for pid in "${pids[@]}"; do wait "$pid" || failed=1; done
done
exit $failed
