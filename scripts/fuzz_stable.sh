#!/usr/bin/env bash
# Looks for inputs that break a reader without a nightly compiler: scripts/fuzz_stable.sh TARGET COUNT [SEED]. Every file of the corpus of the
# target is changed, COUNT times in all, by seeds from SEED on (0); not led by what the changes reach, as scripts/fuzz.sh is.
# What breaks a target is printed, and kept in fuzz/artifacts/TARGET: move it to fuzz/corpus/TARGET, mend, and it is a test.
set -euo pipefail
cd "$(dirname "$0")/.."

if (($# < 2 || $# > 3)) || [[ ! -d fuzz/corpus/$1 ]] || ! [[ $2 =~ ^[0-9]+$ && ${3:-0} =~ ^[0-9]+$ ]]; then
    echo "usage: scripts/fuzz_stable.sh TARGET COUNT [SEED], TARGET one of: $(cd fuzz/corpus && echo *)" >&2
    exit 2
fi
files=$(find "fuzz/corpus/$1" -type f | wc -l)
HEXBENCH_FUZZ_TARGET=$1 HEXBENCH_FUZZ_MUTATIONS=$((($2 + files - 1) / files)) HEXBENCH_FUZZ_SEED=${3:-0} \
    cargo test --workspace --test replay --locked --quiet -- --nocapture no_input | grep -v '^$'
