#!/usr/bin/env bash
# Makes pages of results again and says which came out the same: scripts/results.sh [--keep] [PAGE ...], without a name every page whose
# figures do not hang on a quiet machine. New pages stand in target/results; --keep puts those that differ into docs/results. docs/README.md
# lists all pages, with those that scripts of their own measure.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

# From seconds to an hour, in this order.
readonly pages=(paper power discriminate poses-repeats-noise robustness discover sensors interactions recovery calibration misread)

# again PAGE FOLDER: the page by the command that it names itself, written to another place.
again() {
    local page=$1 out=$2 words
    words=$(sed -n "s|^hexbench \(validate $page .*\) -o DIR --markdown .*|\1|p" "docs/results/$page.md")
    [[ -n $words ]] || fail "docs/results/$page.md does not say how it was made"
    # shellcheck disable=SC2086  # the words of a command, patterns of names among them
    "$HEXBENCH_BINARY" $words --out "$out/.$page" --markdown "$out/$page.md"
}

# make PAGE FOLDER: the page, with a folder of its figures beside it.
make() {
    local page=$1 out=$2
    case $page in
    paper) "$HEXBENCH_BINARY" validate paper --seed 1 --out "$out" ;;
    robustness | discover | sensors | calibration | misread) again "$page" "$out" ;;
    poses-repeats-noise)
        "$HEXBENCH_BINARY" study data/studies/poses-and-noise.toml --out "$out/.study" --markdown "$out/$page.md"
        ;;
    *) "$HEXBENCH_BINARY" validate "$page" --markdown "$out/$page.md" ;;
    esac
}

# differs PAGE FOLDER: prints what of the page and its figures is not as committed.
differs() {
    local page=$1 out=$2 name
    for name in "$page.md" "$page"; do
        [[ -e docs/results/$name || -e $out/$name ]] || continue
        diff --recursive --brief "docs/results/$name" "$out/$name" || true
    done
}

keep=
if [[ ${1:-} == --keep ]]; then
    keep=yes
    shift
fi
(($#)) || set -- "${pages[@]}"
for page in "$@"; do
    [[ " ${pages[*]} " == *" $page "* ]] || fail "no page \`$page\` is made here; use one of: ${pages[*]}"
done
release_binary
out=$(realpath -m "${CARGO_TARGET_DIR:-target}")/results
mkdir -p "$out"
changed=0
for page in "$@"; do
    rm -rf "${out:?}/$page" "$out/$page.md" "$out/.$page" "$out/.study"
    begun=$SECONDS
    make "$page" "$out" >"$out/$page.log" 2>&1 || fail "$page; see $out/$page.log"
    if [[ -z $(differs "$page" "$out") ]]; then
        said=equal
    else
        said=differs changed=$((changed + 1))
        [[ -z $keep ]] || cp -r "$out/$page.md" $([[ ! -d $out/$page ]] || echo "$out/$page") docs/results/
    fi
    printf '%6d s  %-8s %s\n' "$((SECONDS - begun))" "$said" "$page"
done
((changed == 0)) || exit 1
