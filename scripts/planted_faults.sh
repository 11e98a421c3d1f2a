#!/usr/bin/env bash
# Plants one fault at a time (data/regress/faults/*.patch) in a copy of the sources, builds the command, runs `hexbench regress`
# beside the committed baseline, and keeps the result of each in DIR as JSON. Fails when a patch no longer applies, a build fails,
# or one of the first three faults goes unseen.
#
#     scripts/planted_faults.sh DIR [FAULT...]
#
# The copy lives in DIR/sources; builds share the target directory. `none` plants nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
if (($# < 1)); then
    echo "usage: scripts/planted_faults.sh DIR [FAULT...]" >&2
    exit 2
fi
mkdir -p "$1"
out=$(realpath "$1")
shift
root=$PWD
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-target}")
export CARGO_TARGET_DIR
# Without it each build takes half the time, and the figures are the same.
export CARGO_PROFILE_RELEASE_LTO=off
faults=("$@")
if ((${#faults[@]} == 0)); then
    for patch in data/regress/faults/*.patch; do faults+=("$(basename "$patch" .patch)"); done
fi

# The copy keeps the times of the files, so that only what a fault touches is built again.
rm -rf "$out/sources"
mkdir "$out/sources"
cp -a Cargo.toml Cargo.lock crates fuzz data scenes docs "$out/sources/"
# What an earlier call built with a fault is older than these.
sed -n 's|^+++ b/||p' data/regress/faults/*.patch | sort -u | (cd "$out/sources" && xargs touch)

plant() {
    [[ $fault == none ]] || (cd "$out/sources" && patch --strip=1 --fuzz=0 --quiet "$@" <"$root/data/regress/faults/$fault.patch")
}

unseen=()
for fault in "${faults[@]}"; do
    printf '== %s\n' "$fault"
    plant
    (cd "$out/sources" && cargo build --release --locked --quiet -p hexbench-cli)
    code=0
    "$CARGO_TARGET_DIR/release/hexbench" regress --baseline "$root/data/regress/baseline.json" --json "$out/$fault.json" \
        >"$out/$fault.txt" || code=$?
    printf '   exit code %d\n' "$code"
    plant --reverse
    case $code in
    0) unseen+=("$fault") ;;
    1) ;;
    *) exit "$code" ;;
    esac
done
rm -rf "$out/sources"

printf '\n%d of %d faults are seen.\n' "$((${#faults[@]} - ${#unseen[@]}))" "${#faults[@]}"
for fault in ${unseen[@]+"${unseen[@]}"}; do
    printf 'not seen: %s\n' "$fault"
    case $fault in [123]-*) missed=1 ;; esac
done
exit "${missed:-0}"
