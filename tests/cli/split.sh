#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The pretend device (preset split) gives the bits of the plain build: hashes of the whole state over the first 2 us of the quick blast. Skipped
# where build/split is not there; .ci/run builds it and runs this again.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

split=$root/build/split/brisance
[[ -x $split ]] || { echo "no build of the preset split"; exit 77; }
[[ $("$split" --version) == *"(build split)"* ]] || wrong "build/split is another build"
for which in plain split; do
    [[ $which == split ]] && BRISANCE=$split
    expect 0 run "cases/blast/air_copper.toml" --preset quick --until "2 us" --hash-every 10 --no-report --out "$tmp/$which"
    grep -o 'step [0-9]* t .* us state [0-9a-f]*' "$tmp/$which/log.txt" >"$tmp/$which.txt"
done
(($(wc -l <"$tmp/plain.txt") >= 4)) || wrong "too few hashes in the log"
diff "$tmp/plain.txt" "$tmp/split.txt" || wrong "the pretend device gives other bits"
finish
