#!/usr/bin/env bash
# Plants one fault at a time (data/regress/faults/*.patch) in a copy of the sources, builds it, runs `hexbench regress` against the
# committed baseline, and keeps the result of each in DIR as JSON. Fails when a patch no longer applies, a build fails, or one of
# the first three faults goes unseen.
#
#     scripts/planted_faults.sh DIR [FAULT...]
#
# HEXBENCH_PROFILE=dev builds faster and runs slower (default: release). The copy lives in DIR/sources; builds share the target
# directory.
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
profile=${HEXBENCH_PROFILE:-release}
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-target}")
export CARGO_TARGET_DIR
program=$CARGO_TARGET_DIR/$([[ $profile == dev ]] && echo debug || echo "$profile")/hexbench-planted
faults=("$@")
if ((${#faults[@]} == 0)); then
    for patch in data/regress/faults/*.patch; do faults+=("$(basename "$patch" .patch)"); done
fi

# The copy keeps the times of the files, so that only what a fault touches is built again.
rm -rf "$out/sources"
mkdir "$out/sources"
cp -a Cargo.toml Cargo.lock crates data scenes docs "$out/sources/"
# A name of its own: nobody takes a faulty program for the real one.
sed -i '/^\[\[bin\]\]/,$ s/^name = "hexbench"$/name = "hexbench-planted"/' "$out/sources/crates/cli/Cargo.toml"
# What an earlier call built with a fault is older than these.
sed -n 's|^+++ b/||p' data/regress/faults/*.patch | sort -u | (cd "$out/sources" && xargs touch)

unseen=()
for fault in "${faults[@]}"; do
    patch=$root/data/regress/faults/$fault.patch
    printf '== %s: %s\n' "$fault" "$(head -n 1 "$patch")"
    (cd "$out/sources" && patch --strip=1 --fuzz=0 --quiet <"$patch")
    (cd "$out/sources" && cargo build --profile "$profile" --locked --quiet -p hexbench-cli)
    code=0
    "$program" regress --baseline "$root/data/regress/baseline.json" --json "$out/$fault.json" || code=$?
    printf '   exit code %d\n' "$code"
    (cd "$out/sources" && patch --strip=1 --fuzz=0 --quiet --reverse <"$patch")
    case $code in
    0) unseen+=("$fault") ;;
    1) ;;
    *) exit "$code" ;;
    esac
done

printf '\n%d of %d faults are seen.\n' "$((${#faults[@]} - ${#unseen[@]}))" "${#faults[@]}"
for fault in ${unseen[@]+"${unseen[@]}"}; do
    printf 'not seen: %s\n' "$fault"
    case $fault in [123]-*) missed=1 ;; esac
done
exit "${missed:-0}"
