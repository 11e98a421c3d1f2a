#!/usr/bin/env bash
# Checks the page: types, lints, formatting, unit tests, and that the committed bundle is what its sources give.
# Exits 77 when node or the package index is missing.
set -euo pipefail
cd "$(dirname "$0")"
source packages.sh
packages

if grep -n '"resolved"' package-lock.json; then
    echo "package-lock.json names a registry; write it with the .npmrc of this folder."
    exit 1
fi

bin=node_modules/.bin
"$bin/tsc" --noEmit
"$bin/biome" check --error-on-warnings
node tests/unit.mjs

built=$(mktemp -d)
trap 'rm -rf "$built"' EXIT
node build.mjs "$built"
if ! diff -rq "$built" ../assets; then
    echo "The committed bundle is stale: run 'npm run build' in crates/workbench/ui and commit crates/workbench/assets."
    exit 1
fi
echo "The page is sound and its bundle is the committed one."
