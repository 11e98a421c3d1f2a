#!/usr/bin/env bash
# Plays the story of the workbench in a real browser, with the program named by HEXBENCH_BINARY or else the debug build.
# Exits 77 when node, the package index or Chromium is missing.
set -euo pipefail
cd "$(dirname "$0")"
source packages.sh
packages

if [[ -z ${HEXBENCH_BINARY:-} ]]; then
    cargo build --locked --quiet --bin hexbench
    HEXBENCH_BINARY=${CARGO_TARGET_DIR:-$(realpath ../../../target)}/debug/hexbench
fi
export HEXBENCH_BINARY
node --test-reporter=spec tests/story.test.mjs
