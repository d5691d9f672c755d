#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Holds a bill of materials against CycloneDX's schema: validate.sh FOLDER BOM. Exit status 77: skipped.
set -euo pipefail
folder="$1" bom="$2"
if ! command -v node >/dev/null; then
  echo "skipped: node is not installed (apt-get install nodejs)"
  exit 77
fi
if [ ! -d "$folder/node_modules" ]; then
  echo "skipped: CycloneDX's schema is missing (npm ci --prefix tests/integration/bom)"
  exit 77
fi
exec node "$folder/validate.mjs" "$bom"
