#!/usr/bin/env bash
# The documentation as a book, target/book/index.html, and every link in it. Needs mdbook (cargo install mdbook) and Python, no network;
# without them it exits with 77, the reason on standard output.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

command -v mdbook >/dev/null || skip "mdbook is not installed (cargo install mdbook)"
[[ $(mdbook --version) == "mdbook v0.5."* ]] || skip "the book is written for mdbook 0.5; this is $(mdbook --version)"
command -v python3 >/dev/null || skip "python3 is not installed"

folder=$(realpath -m "${CARGO_TARGET_DIR:-target}")/book
python3 scripts/frames_figure.py --check
messages=$folder.log
mkdir -p "$(dirname "$folder")"
RUST_LOG=warn mdbook build --dest-dir "$folder" >"$messages" 2>&1 || { cat "$messages" >&2; fail "mdbook build"; }
if grep -E 'WARN|ERROR' "$messages"; then fail "mdbook warns"; fi
python3 scripts/book_check.py "$folder" || fail "links of the book"
printf '%s/index.html\n' "$folder"
