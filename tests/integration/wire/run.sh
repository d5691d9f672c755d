#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs wire_test.js with the given arguments; exit status 77 = skipped, the reason is printed.
set -eu
here=$(dirname "$0")
skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "Node.js is not installed (apt-get install nodejs npm)"
command -v socat >/dev/null || skip "socat is not installed (apt-get install socat)"
[ -d "$here/node_modules/node-mavlink" ] || skip "npm packages are missing (npm ci --prefix $here)"
exec node "$here/wire_test.js" "$@"
