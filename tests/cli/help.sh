#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The program says what it is and what it can do, and an order that it does not understand is exit code 2.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

expect 0 --version
says out '^brisance [0-9]+\.[0-9]+\.[0-9]+ \([0-9a-f]+(-dirty)?\), |^brisance .* \(unknown\), ' 'HDF5'

expect 0 --help
says out '^Usage:' 'Exit codes: 0 ok, 2 bad input, 3 .*, 4 .*, 5 interrupted'
mapfile -t commands < <(sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p' "$tmp/out")
for name in run resume check analyze report view verify materials material bench reference; do
    [[ " ${commands[*]} " == *" $name "* ]] || wrong "--help does not list $name (it lists: ${commands[*]})"
done
for name in "${commands[@]}"; do
    expect 0 "$name" --help
    says out '^Usage:' '.{20}'
    silent err
done

expect 2
expect 2 frobnicate
expect 2 check
expect 2 check cases/blast/air.toml --no-such-flag
expect 2 run cases/blast/air.toml --threads 0
expect 2 verify --lane slow
expect 2 verify nonsense
says err "no verification case 'nonsense'; there are: .*sod"
expect 0 verify --list
says out '^sod +fluids +Sod'
expect 2 bench nonsense
says err "no measurement 'nonsense'; there are: .*rock"
expect 0 bench law_jh2 --repeat 1 --threads 1 --json
says out '"name": "law_jh2".*"threads": 1, "rate": [0-9.e+]+'
finish
