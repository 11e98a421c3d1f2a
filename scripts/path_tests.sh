#!/usr/bin/env bash
# Outputs, places and files of a command, tested as an ordinary user where ./test runs as root: what root may do hides what others may not.
# Needs the test program that `cargo test --workspace --test cli --no-run` builds, and setpriv (util-linux).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

program=$(cargo test --workspace --test cli --no-run --locked 2>&1 | sed -n 's/.*tests\/cli\/main.rs (\(.*\))$/\1/p')
[[ -x $program ]] || fail "the test program of the command is not built"
tests=(outputs:: streams:: hand_changed:: hostile_text:: faults::places_)
if [[ $(id -u) != 0 ]]; then
    echo "an ordinary user runs this already; as root is not tried"
    exec cargo test --workspace --test cli --locked --quiet -- "${tests[@]}"
fi
command -v setpriv >/dev/null || skip "setpriv is not installed, and root may do everything"

# The user needs a folder for files of the tests, and may read the program and the repository.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chown 65534:65534 "$work"
nobody=(setpriv --reuid=65534 --regid=65534 --clear-groups env HOME="$work" TMPDIR="$work" RUST_BACKTRACE=0)
program=$(realpath "$program")
"${nobody[@]}" "$program" --list >/dev/null 2>&1 || skip "an ordinary user may not read $program"
cd crates/cli
"$program" --quiet "${tests[@]}"
"${nobody[@]}" "$program" --quiet "${tests[@]}"
