#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What takes too long for every change, part by part: ./dev nightly [--continue] [--quick] [PART...]
# Every part leaves a row in build/nightly/report.md and what it printed in build/nightly/PART.txt.
set -euo pipefail

folder=build/nightly
report=$folder/report.md
running=

# Name, minutes that it may take, what ./dev is told. Short ones first: a night that ends early has told something.
parts() {
  cat <<'TEXT'
tsan           120 test --preset tsan
soak-release    90 test --soak --release
soak           120 test --soak
clang          180 test --preset clang
asan           240 test --preset asan
fresh          120 test --fresh
package-arm64  180 package aarch64
package-armhf  180 package armhf
ros2-arm64     240 test --ros2 --preset aarch64
hil            240 test --hil
soak-valgrind  360 test --soak --valgrind
fuzz           240 fuzz 600
cross          480 test --cross
firmware       480 test --firmware --repeat 20 --busy
repeat         600 test --repeat 20 --busy
TEXT
}

# What one sitting has time for.
quick_parts() {
  parts | sed -e 's/fuzz 600/fuzz 60/' -e 's/--repeat 20/--repeat 2/' -e 's/--soak/--soak --minutes 5/'
}

say() { printf '== %s\n' "$*" >&2; }
die() { printf 'nightly: %s\n' "$*" >&2; exit 1; }

# What was built; what was changed since has no name, so that it never counts as passed.
commit() { git describe --always --dirty --abbrev=10 --exclude '*' 2>/dev/null || echo unknown-dirty; }

has_passed() { # has_passed COMMIT COMMAND: the report says so
  [[ "$1" != *-dirty ]] && [ -f "$report" ] && awk -F ' *[|] *' -v commit="$1" -v command="$2" \
    '$2 == commit && $3 == command && $6 == "passed" { found = 1 } END { exit !found }' "$report"
}

# What counts of a part's output, in one line.
figures() { # figures LOG
  sed -nE \
    -e 's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$/\2 tests, \1 failed/p' \
    -e 's/^([0-9]+ skipped):$/\1/p' \
    -e '/^[0-9]+ of [0-9]+ rounds passed$/p' \
    -e 's/^(fuzz_[a-z_]+: [0-9]* inputs(, FAULT)?).*/\1/p' \
    -e '/^(soak: .* simulated minutes|hil: |fresh: )/p' \
    -e '/^(OK|FAILED) \(.*\)$/p' \
    -e 's/^[^ ]+: (unpacked and run|installed, used and removed)/\1/p' \
    -e 's/^== (skipped: .*)/\1/p' "$1" | awk '!seen[$0]++' | tr '|' '/' | paste -s -d ';' | sed 's/;/; /g'
}

outcome() { # outcome STATUS LOG
  case "$1" in
    0) if grep -q '^== skipped: ' "$2"; then echo skipped; else echo passed; fi ;;
    # Those of timeout, which ended it.
    124 | 137) echo "over its limit" ;;
    *) echo "failed ($1)" ;;
  esac
}

# What is left of a part when ./dev has ended; it has a minute to tidy up.
end_group() { # end_group PROCESS_GROUP
  local try
  for ((try = 0; try < 60; try++)); do
    kill -TERM -- "-$1" 2>/dev/null || return 0
    sleep 1
  done
  kill -KILL -- "-$1" 2>/dev/null || true
}

write_row() { # write_row COMMIT COMMAND BEGUN SECONDS OUTCOME FIGURES
  [ -f "$report" ] || printf '%s\n' '| commit | ./dev | begun | s | outcome | figures |' '|---|---|---|---:|---|---|' >"$report"
  printf '| %s | %s | %s | %s | %s | %s |\n' "$@" >>"$report"
}

run_part() { # run_part NAME MINUTES COMMAND...
  local name="$1" minutes="$2" log="$folder/$1.txt" begin=$SECONDS status=0 commit begun result
  shift 2
  commit="$(commit)"
  begun="$(date '+%Y-%m-%d %H:%M')"
  say "$name: ./dev $*, at most $minutes minutes; see $log"
  # In a process group of its own, which timeout makes. Tests send signals that nohup and & leave ignored. Nobody is there to ask.
  timeout --kill-after=60 "${minutes}m" env --default-signal ./dev "$@" </dev/null >"$log" 2>&1 &
  running=$!
  wait "$running" || status=$?
  end_group "$running"
  running=
  result="$(outcome "$status" "$log")"
  write_row "$commit" "$*" "$begun" $((SECONDS - begin)) "$result" "$(figures "$log")"
  say "$name: $result after $((SECONDS - begin)) s; $(figures "$log")"
  if [ "$status" -ne 0 ]; then tail -n 20 "$log" >&2; fi
  return "$status"
}

# Ctrl-C reaches this script alone, not the part.
break_off() {
  if [ -n "$running" ]; then
    kill "$running" 2>/dev/null || true
    end_group "$running"
  fi
  say "broken off; ./dev nightly --continue goes on"
  exit 130
}

is_wanted() { # is_wanted NAME WANTED...: it is among them, or nothing is
  [ $# -eq 1 ] || [[ " ${*:2} " = *" $1 "* ]]
}

main() {
  local list=parts go_on='' wanted=() failed=() name minutes command words
  while [ $# -gt 0 ]; do
    case "$1" in
      --continue) go_on=1 ;;
      --quick) list=quick_parts ;;
      -*) die "unknown option $1; see ./dev help" ;;
      *)
        parts | grep "^$1 " >/dev/null || die "there is no part $1, but $(parts | cut -d ' ' -f 1 | paste -s -d ' ')"
        wanted+=("$1")
        ;;
    esac
    shift
  done
  mkdir -p "$folder"
  trap break_off INT TERM
  while read -r -u 3 name minutes command; do
    is_wanted "$name" "${wanted[@]}" || continue
    if [ -n "$go_on" ] && has_passed "$(commit)" "$command"; then continue; fi
    read -r -a words <<<"$command"
    run_part "$name" "$minutes" "${words[@]}" || failed+=("$name")
  done 3< <($list)
  say "all results: $report"
  [ ${#failed[@]} -eq 0 ] || die "failed: ${failed[*]}"
}

# Its functions are tested (tests/unit/dev), so it may be sourced as well.
if [ "${BASH_SOURCE[0]}" = "$0" ]; then
  cd "$(dirname "${BASH_SOURCE[0]}")/.."
  main "$@"
fi
