#!/usr/bin/env bash
# Spelling of sources and documents, in American English. typos.toml has the words of the field. Needs typos, or Python and a package index.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

typos=$(command -v typos) || {
    work=$(realpath -m "${CARGO_TARGET_DIR:-target}")/spelling
    mkdir -p "$work"
    prepare_python "$work" spelling
    typos=$work/venv/bin/typos
}
"$typos" --config typos.toml || fail "spelling"
