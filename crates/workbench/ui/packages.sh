# Sourced by scripts that need node: the packages of package-lock.json, installed once, and a browser with its driver, which is one of
# them. Exits 77 when node, the package index or Chromium is missing.

source "$(dirname "${BASH_SOURCE[0]}")/../../../scripts/common.sh"

packages() {
    command -v node >/dev/null && command -v npm >/dev/null || skip "node and npm are not installed."
    (($(node -p 'process.versions.node.split(".")[0]') >= 20)) || skip "node is older than 20."
    local stamp=node_modules/.package-lock-installed log
    cmp -s package-lock.json "$stamp" && return
    log=$(mktemp)
    if ! npm ci --ignore-scripts --no-audit --no-fund >"$log" 2>&1; then
        cat "$log"
        # A lock file that does not fit is a fault of ours, not of the network.
        grep -qE 'EUSAGE|EINTEGRITY' "$log" && exit 1
        skip "npm ci found no package index (its messages are above)."
    fi
    cp package-lock.json "$stamp"
}

find_chromium() {
    local name
    for name in "${HEXBENCH_CHROMIUM:-}" chromium chromium-browser google-chrome; do
        [[ -n $name ]] && command -v "$name" && return
    done
    return 1
}

prepare_browser() {
    HEXBENCH_CHROMIUM=$(find_chromium) || skip "Chromium is not installed (HEXBENCH_CHROMIUM may name one)"
    export HEXBENCH_CHROMIUM
    (cd "$(dirname "${BASH_SOURCE[0]}")" && packages) || exit
}
