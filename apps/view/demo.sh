#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tracks a simulated bottle for five minutes and shows it live in the browser. Usage: demo.sh BIN_DIR PORT
set -eu

if [ $# -ne 2 ]; then
  echo "usage: $0 BIN_DIR PORT" >&2
  exit 2
fi
# In the environment: other users may read a command line.
DISFLOW_VIEW_TOKEN=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
export DISFLOW_VIEW_TOKEN
url="http://127.0.0.1:$2/?token=$DISFLOW_VIEW_TOKEN"
echo "== open $url in a browser; Ctrl-C ends the demonstration"
if command -v xdg-open >/dev/null && [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  (sleep 2 && xdg-open "$url" >/dev/null 2>&1) &
fi
exec "$1/disflow_track" --sensor 'sim:bottle?frames=9000&motion=fast&noise=d415' --rate realtime \
  --view "127.0.0.1:$2" --view-hold
