#!/usr/bin/env bash
# Checks the page: types, lints, formatting, unit tests, and that the committed bundle is what its sources give.
# Exits 77 when node or the package index is missing.
set -euo pipefail
cd "$(dirname "$0")"

cannot_run() {
    printf 'The page cannot be checked: %s\n' "$1"
    exit 77
}

command -v node >/dev/null && command -v npm >/dev/null || cannot_run "node and npm are not installed."
(($(node -p 'process.versions.node.split(".")[0]') >= 20)) || cannot_run "node is older than 20."

stamp=node_modules/.package-lock-checked
if ! cmp -s package-lock.json "$stamp"; then
    log=$(mktemp)
    if ! npm ci --ignore-scripts --no-audit --no-fund >"$log" 2>&1; then
        cat "$log"
        # A lock file that does not fit package.json is a fault of ours, not of the network.
        grep -qE 'EUSAGE|EINTEGRITY' "$log" && exit 1
        cannot_run "npm ci found no package index (its messages are above)."
    fi
    cp package-lock.json "$stamp"
fi

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
