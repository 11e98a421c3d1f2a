#!/usr/bin/env bash
# Writes scripts/requirements/*.txt from the *.in beside them: every package with its version and the hashes of its files, for every
# system and every Python from 3.11 on. Pinned versions stay unless --upgrade is given.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

work=$(realpath -m "${CARGO_TARGET_DIR:-target}")/lock
mkdir -p "$work"
prepare_python "$work" lock
cd scripts/requirements
for asked in *.in; do
    "$work/venv/bin/uv" pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-annotate \
        --custom-compile-command "scripts/lock_python.sh" "$@" "$asked" -o "${asked%.in}.txt"
done
