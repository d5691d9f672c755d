#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# tests/nightly.sh, with a ./dev that is made up and a repository of its own.
# shellcheck source=/dev/null disable=SC2317  # parts are called by what is tested
source "$(dirname "${BASH_SOURCE[0]}")/../../nightly.sh"
set +e
folder_of_test="$(mktemp -d)"
trap 'rm -rf "$folder_of_test"' EXIT
cd "$folder_of_test" || exit 1
failures=0
fail() {
  echo "$*"
  failures=$((failures + 1))
}
nightly() { # nightly ARGUMENT...: its status; what ./dev was asked for is in asked, what was printed in printed
  rm -f asked
  (main "$@") >printed 2>&1
}
expect_asked() { # expect_asked LINE...: what ./dev was asked for, in that order
  [ "$(cat asked 2>/dev/null)" = "$(printf '%s\n' "$@")" ] || fail "line ${BASH_LINENO[0]}: asked for: $(cat asked 2>/dev/null)"
}
expect_row() { # expect_row PATTERN: the report has such a row
  grep -qE -- "$1" build/nightly/report.md || fail "line ${BASH_LINENO[0]}: no row $1 in: $(cat build/nightly/report.md)"
}

cat >dev <<'TEXT'
#!/usr/bin/env bash
echo "$*" >>asked
case "$1" in
  good) echo '100% tests passed, 0 tests failed out of 24'; echo 'none skipped' ;;
  bad) echo 'why it failed'; exit 3 ;;
  hangs) (trap '' TERM; echo "$BASHPID" >child; exec sleep 1000) & sleep 1000 ;;
  slow) while [ ! -e go ]; do sleep 0.1; done ;;
  asks) read -r answer || exit 4; echo "answer: $answer" ;;
  signals) trap 'exit 0' INT; kill -INT $$; exit 1 ;;
  skips) echo '== skipped: only root may' ;;
esac
TEXT
chmod +x dev
printf '%s\n' /build/ asked printed child go >.gitignore
git init -q .
commit_all() { git -c user.name=x -c user.email=x@example.org commit -q --allow-empty -m "$1"; }
git add dev .gitignore
commit_all one

# --- the real list: names are one word and there once, limits are numbers, --quick changes the lengths alone
[ "$(parts | cut -d ' ' -f 1 | sort | uniq -d)" = '' ] || fail "a part is there twice"
[ "$(parts | grep -cvE '^[a-z0-9-]+ +[0-9]+ (test|fuzz|package) ?')" -eq 0 ] || fail "a part is none"
[ "$(quick_parts | cut -c 1-15)" = "$(parts | cut -c 1-15)" ] || fail "--quick has other parts"
[ "$(quick_parts | grep -cE -- 'fuzz 60$|--soak --minutes 5|--repeat 2 ')" -eq 6 ] || fail "--quick is as long"

# --- a part that fails does not end the rest, and is named
parts() { printf '%s\n' 'first 1 bad thing' 'second 1 good thing'; }
nightly && fail "a part failed"
expect_asked 'bad thing' 'good thing'
expect_row "^\| $(git rev-parse --short=10 HEAD) \| bad thing \| [-0-9]+ [0-9:]+ \| [0-9]+ \| failed \(3\) \|  \|$"
expect_row "\| good thing \| .* \| passed \| 24 tests, 0 failed \|$"
grep -q 'why it failed' printed || fail "what it printed last is not shown"
grep -q 'nightly: failed: first$' printed || fail "it is not named at the end"

# --- --continue leaves out what passed at this commit, and nothing else
nightly --continue && fail "it fails again"
expect_asked 'bad thing'
parts() { printf '%s\n' 'second 1 good thing'; }
nightly --continue || fail "there is nothing left to fail"
expect_asked
nightly || fail "without --continue it runs again"
expect_asked 'good thing'
commit_all two
nightly --continue
expect_asked 'good thing'
echo '# changed' >>dev
nightly --continue
nightly --continue
expect_asked 'good thing'
expect_row '^\| [0-9a-f]+-dirty \| good thing '
git checkout -q dev

# --- parts by name; a name that is none is refused before anything runs
parts() { printf '%s\n' 'first 1 good 1' 'second 1 good 2' 'third 1 good 3'; }
nightly third first || fail "two parts"
expect_asked 'good 1' 'good 3'
nightly first fourth && fail "there is no fourth"
expect_asked
grep -q 'no part fourth, but first second third' printed || fail "parts are not listed"
nightly --no-such-option && fail "there is no such option"
expect_asked

# --- a part that hangs is ended with all that it started, also what ignores SIGTERM; the rest runs
sleep() { command sleep 0.01; } # The minute that it has to tidy up, shortened.
parts() { printf '%s\n' 'first 0.1 hangs' 'second 1 good'; }
nightly && fail "a part hung"
expect_asked hangs good
expect_row '\| hangs \| .* \| over its limit \|'
kill -0 "$(cat child)" 2>/dev/null && [ "$(ps -o stat= -p "$(cat child)" | cut -c 1)" != Z ] && fail "its child is still there"

# --- broken off: the part ends, and the next run goes on there
parts() { printf '%s\n' 'first 1 good' 'second 1 slow'; }
(main) >printed 2>&1 &
nightly_pid=$!
until grep -qs '^slow' asked; do command sleep 0.05; done
kill -TERM "$nightly_pid"
wait "$nightly_pid"
[ $? -eq 130 ] || fail "broken off has a status of its own"
touch go
nightly --continue || fail "it goes on"
expect_asked slow

# --- nobody can be asked; signals that nohup ignores are not ignored in the tests; what was skipped has not passed
parts() { printf '%s\n' 'first 1 asks' 'second 1 signals' 'third 1 skips'; }
(
  trap '' INT HUP
  main <<<yes
) >printed 2>&1
expect_row '\| asks \| .* \| failed \(4\) \|'
expect_row '\| signals \| .* \| passed \|'
expect_row '\| skips \| .* \| skipped \| skipped: only root may \|'

# --- figures: one line of what counts, in its order, each once
cat >log <<'TEXT'
fuzz_model: 12345 inputs
fuzz_tracker: 678 inputs, FAULT, see /somewhere/fuzz_tracker.txt
96% tests passed, 1 tests failed out of 24
96% tests passed, 1 tests failed out of 24
3 skipped:
19 of 20 rounds passed
soak: 30.0 simulated minutes in 500 s, 53000 frames tracked, 90000 kB resident, grown by 0 kB, descriptors [9]
soak: memory or descriptors grew, or too little was tracked
hil: 15 tests in 300 s
OK (skipped=2)
disflow_0.1.deb: unpacked and run
unrelated | line
TEXT
wanted='fuzz_model: 12345 inputs; fuzz_tracker: 678 inputs, FAULT; 24 tests, 1 failed; 3 skipped; 19 of 20 rounds passed; '
wanted+='soak: 30.0 simulated minutes in 500 s, 53000 frames tracked, 90000 kB resident, grown by 0 kB, descriptors [9]; '
wanted+='hil: 15 tests in 300 s; OK (skipped=2); unpacked and run'
[ "$(figures log)" = "$wanted" ] || fail "figures: $(figures log)"

[ "$failures" -eq 0 ] || exit 1
echo "all as expected"
