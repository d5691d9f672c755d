#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs a script of this folder, the first argument, with the others; exit status 77 = skipped, the reason is printed.
set -eu
here=$(dirname "$0")
skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "Node.js is not installed (apt-get install nodejs npm)"
command -v socat >/dev/null || skip "socat is not installed (apt-get install socat)"
[ -d "$here/node_modules/node-mavlink" ] || skip "npm packages are missing (npm ci --prefix $here)"
script=$1
shift
exec node "$here/$script" "$@"
