#!/usr/bin/env bash
# Counts how often an idea stands in the sources: scripts/structure.sh [CHECKOUT ...]. One column for each checkout, for a look at a change
# of structure; what a row counts stands beside it as the pattern that is searched.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
(($#)) || set -- "$here"

# Rust sources of a checkout without tests, examples and benchmarks.
sources() { find "$1"/crates/*/src -name '*.rs'; }
# Lines of the sources that match a pattern.
matches() { sources "$1" | xargs grep -hE -- "$2" | wc -l; }
# Files of the sources that match a pattern.
files() { sources "$1" | xargs grep -lE -- "$2" | wc -l; }

row() {
    local name=$1 count=$2 pattern=$3 root
    shift 3
    printf '%-34s' "$name"
    for root in "$@"; do printf '%9s' "$($count "$root" "$pattern")"; done
    printf '   %s\n' "$pattern"
}

crates() { find "$1"/crates -mindepth 2 -maxdepth 2 -name Cargo.toml | wc -l; }
lines() { sources "$1" | xargs cat | wc -l; }
# Without tests (files of tests, and modules of tests, which end their file), comments and blank lines.
code() {
    sources "$1" | grep -vE '/tests?(/|\.rs)|_tests\.rs$' |
        xargs awk 'FNR == 1 { tests = 0 } attribute && /^mod / { tests = 1 } { attribute = /^#\[cfg\(test\)\]/ } !tests && !/^ *(\/\/|$)/ { n++ } END { print n }'
}
tests() { find "$1"/crates/*/tests "$1"/crates/*/src -name '*.rs' | xargs grep -hE '^ *#\[test\]' | wc -l; }

# Declarations of public types, and names that stand for more than one of them.
types() { sources "$1" | xargs grep -hoE '^pub (struct|enum|trait|type) [A-Za-z0-9]+' | cut -d' ' -f3; }
public_types() { types "$1" | wc -l; }
names_of_several() { types "$1" | sort | uniq -d | wc -l; }
programs() { find "$1"/crates/*/tests -maxdepth 2 -name '*.rs' \( -path '*/tests/*/main.rs' -o -path '*/tests/[a-z_]*.rs' ! -path '*/tests/*/*' \) | wc -l; }

row "crates" crates "" "$@"
row "lines of Rust source" lines "" "$@"
row "of these code, tests aside" code "" "$@"
row "tests" tests "" "$@"
row "test programs" programs "" "$@"
row "public types" public_types "" "$@"
row "names of several public types" names_of_several "" "$@"
row "document models" matches 'pub (struct (Document|Paper|Page) \{|fn (to_text|to_markdown|into_text)\()' "$@"
row "table types" matches '(pub struct (Table|Sheet|Frame)\b|^    Table \{)' "$@"
row "writers of comma-separated text" files 'join\(","\)|push\(.,.\)|write!\([a-z]+, ",\{|"\{\},\{\}' "$@"
row "Monte-Carlo loops" files '(par_iter|into_par_iter)\(\).*|rayon::prelude' "$@"
row "journals and folder locks" files 'try_lock\(\)' "$@"
row "fn percent" matches 'fn percent\(' "$@"
row "fn median, quantile" matches 'fn (median|quantile|upper_quantile)\b' "$@"
row "words of a verdict" matches 'Verdict::Adequate => "adequate"|\{:\?\}", .*verdict\)\.to_lowercase' "$@"
row "raw random generators" matches 'Pcg64::new\(|seed_from_u64\(' "$@"
