#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The functions of ./dev, on a machine whose package database is made up.
# shellcheck source=/dev/null disable=SC2317  # ./dev calls what is defined here
source "$(dirname "${BASH_SOURCE[0]}")/../../../dev"
unset CI
failures=0
expect() { # expect EXIT_STATUS COMMAND...: what is called must hold
  local wanted="$1" status=0
  shift
  ("$@") >/dev/null 2>&1 || status=$?
  [ "$status" -eq "$wanted" ] || {
    echo "$*: status $status, $wanted was expected"
    failures=$((failures + 1))
  }
}

# --- is_installed: only packages of the architecture asked for count
dpkg() { echo amd64; }
dpkg-query() {
  case "${!#}" in
    libforeign-dev) echo "installed arm64" ;;
    libboth-dev) printf 'installed amd64\ninstalled arm64\n' ;;
    libheaders-dev) echo "installed all" ;;
    libremoved-dev) echo "config-files amd64" ;;
    *) return 1 ;;
  esac
}
expect 1 is_installed libforeign-dev
expect 0 is_installed libforeign-dev:arm64
expect 0 is_installed libboth-dev
expect 0 is_installed libboth-dev:arm64
expect 1 is_installed libboth-dev:armhf
expect 0 is_installed libheaders-dev
expect 0 is_installed libheaders-dev:arm64
expect 1 is_installed libremoved-dev
expect 1 is_installed libnever-dev
expect 0 is_installed bash@bash
expect 1 is_installed no-such-command@no-such-package

# --- package_exists: much output is no failure (a pipe into grep -q would end with SIGPIPE)
apt-cache() { [ "$2" = known ] && yes 'Maintainer: Debian' | head -c 1000000; }
expect 0 package_exists known
expect 1 package_exists unknown

# --- skip: a remark on a developer's machine, a failure on CI
expect 0 skip "no browser"
skip_on_ci() { CI=1 skip "no browser"; }
expect 1 skip_on_ci

# --- build: options are told from mistakes before anything is installed
need() { exit 42; }
expect 42 build release -DDISFLOW_WITH_VIEW=OFF --target disflow_track
expect 1 build release --no-such-option
expect 1 run_tests --repeat
expect 1 run_tests --repeat none

# --- bench: PCL is for the peers alone
need() { [[ " $* " != *" libpcl-dev "* ]] || exit 42; }
build() { exit 43; }
expect 42 run_bench peers
expect 43 run_bench ablation
need() { :; }
build() { [[ " $* " = *" -DDISFLOW_BUILD_PEERS=ON "* ]] && exit 44; exit 43; }
expect 44 run_bench peers
expect 43 run_bench

# --- soak: which build it is that runs
need() { :; }
build() { echo "$1"; }
python3() { [ "$4" = "build/$wanted/bin/disflow_track" ] && [ "${*:5}" = "$told" ]; }
soaked() { # soaked BUILD OPTIONS ARGUMENT...: what soak.py is told
  local wanted="$1" told="$2"
  shift 2
  run_soak "$@"
}
expect 0 soaked asan ""
expect 0 soaked asan "--minutes 3" --minutes 3
expect 0 soaked release "--minutes 3" --minutes 3 --release
expect 0 soaked release "--valgrind" --valgrind
expect 1 soaked asan "" --release

# --- watch_ninja, watch_apt: steps become progress, and what is no step is seen
seen() { # seen WORDS COMMAND...: the command's output holds them
  local words="$1" output
  shift
  output="$("$@" 2>&1)"
  [[ "$output" == *"$words"* ]] || {
    echo "$*: '$words' was expected in: $output"
    failures=$((failures + 1))
  }
}
a_build() {
  printf '[%s of 4] Building\n' 1 2 3 4 | watch_ninja
}
a_failed_build() {
  printf '%s\n' '[1 of 4] Building a.cc' 'FAILED: a.o' 'a.cc:1: error: no' 'ninja: build stopped: subcommand failed.' | watch_ninja
}
an_installation() {
  printf '%s\n' 'dlstatus:1:50.0:Retrieving' 'Get:1 something' 'pmstatus:g++:10.0:Unpacking' 'pmstatus:g++:60.5:Unpacking' \
    'pmerror:a:b:c' '' ':::' | watch_apt
}
seen 'build: 25 %, about 0 s left' a_build
seen 'build: 75 %' a_build
seen 'FAILED: a.o' a_failed_build
seen 'a.cc:1: error: no' a_failed_build
seen 'build stopped' a_failed_build
seen 'packages: 25 %' an_installation
seen 'packages: 80 %' an_installation
expect 0 tell_left build 0 0 0
expect 1 run_tests --fresh-air

# --- make_target_root: fetched once, and anew when other packages are wanted
fetches() { # fetches PACKAGES: where these are there already
  cd "$(mktemp -d)" || exit 1
  trap 'rm -rf "$PWD"' EXIT
  mkdir -p toolchains build/aarch64-root
  printf '#!/bin/sh\nexit 45\n' >toolchains/debian_root.sh
  chmod +x toolchains/debian_root.sh
  echo "$1" >build/aarch64-root/packages
  make_target_root aarch64
}
mmdebstrap() { :; }
# shellcheck disable=SC2154  # of ./dev
expect 0 fetches "${target_libraries[*]}"
expect 1 fetches "${target_libraries[*]:1}"

# --- need_later: in the background only where nobody has to be asked
id() { echo 0; }
need() { :; }
later() { need_later gnuplot && [ -n "$later_pid" ] && wait "$later_pid"; }
expect 0 later
id() { echo 1000; }
not_later() { need_later gnuplot && [ -z "$later_pid" ]; }
expect 0 not_later

[ "$failures" -eq 0 ] || exit 1
echo "all as expected"
