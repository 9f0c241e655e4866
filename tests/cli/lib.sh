#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Sourced by the tests of the command line. BRISANCE is the program; the test stands in the root of the repository and has an
# empty folder of its own, $tmp. `finish` at the end gives the exit status.
set -u
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
cd "$root" || exit 1
BRISANCE=${BRISANCE:-$root/build/release/brisance}
[[ -x $BRISANCE ]] || { echo "no program at $BRISANCE"; exit 1; }
tmp=$(mktemp -d) || exit 1
trap 'rm -rf -- "$tmp"' EXIT
failures=0
command=
shown=

# wrong TEXT: counts a failure; with the first of a run comes what the run wrote.
wrong() {
    failures=$((failures + 1))
    printf 'WRONG: %s\n' "$*"
    [[ $shown == "$command" ]] && return
    shown=$command
    sed 's/^/  stdout: /' "$tmp/out" | tail -n 20
    sed 's/^/  stderr: /' "$tmp/err" | tail -n 20
}

# expect CODE ARGUMENTS: runs the program; its output goes to $tmp/out and $tmp/err.
expect() {
    local code=$1 got
    shift
    command="brisance $*"
    "$BRISANCE" "$@" >"$tmp/out" 2>"$tmp/err" </dev/null
    got=$?
    ((got == code)) || wrong "$command: exit code $got, not $code"
}

# says out|err PATTERN...: each an extended regular expression that the last run must have written there.
says() {
    local where=$1 pattern
    shift
    for pattern in "$@"; do
        grep -Eq -- "$pattern" "$tmp/$where" || wrong "$command: no '$pattern' on std$where"
    done
}

# silent out|err: the last run must have written nothing there.
silent() {
    [[ ! -s $tmp/$1 ]] || wrong "$command: writes on std$1"
}

finish() {
    ((failures == 0)) || { echo "$failures wrong"; exit 1; }
    exit 0
}
