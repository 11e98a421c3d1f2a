#!/usr/bin/env bash
# From the numbers of a drawing, ball centers and a list of loads to the verdict, and nothing else: scripts/ten_minutes.sh. Counts the
# commands and the keys pressed for them (with the one that ends a line), and the time that they compute. HEXBENCH_BINARY names the
# program; without it the optimised one is built.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
release_binary
program=$(realpath "$HEXBENCH_BINARY")

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/desk"
"$program" simulate scenes/paper-rich -o "$folder/trial" >"$folder/simulated.txt"
# What lies on the desk: two files of a measuring machine. The numbers of the drawing are in the first command.
cp "$folder/trial/balls.csv" "$folder/trial/loads.csv" "$folder/desk"

typed=(
    "hexbench init --base-radius 160 --base-gap 20 --platform-radius 120 --platform-gap 20 --height 165"
    "hexbench campaign balls.csv loads.csv -o campaign"
    "hexbench diagnose hexapod.toml campaign/measurements.csv"
)
cd "$folder/desk"
keys=0
SECONDS=0
for line in "${typed[@]}"; do
    keys=$((keys + ${#line} + 1))
    read -ra words <<<"$line"
    "$program" "${words[@]:1}" >page.txt 2>messages.txt || fail "$line: $(cat messages.txt)"
    printf '$ %s\n' "$line"
done
grep -q 'NAMED' page.txt && grep -q 'base-compliance' page.txt || fail "the verdict is not base-compliance"
printf '%d commands, %d keys, %d s of computing: NAMED base-compliance, the foundation yields\n' \
    "${#typed[@]}" "$keys" "$SECONDS"
