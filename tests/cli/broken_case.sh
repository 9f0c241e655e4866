#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A mistake in a case ends the program with exit code 2 before anything is computed. The message says where, what, and what is allowed.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

# broken LINE PATTERN...: a case whose third line is LINE, in the table of the rock.
broken() {
    local line=$1
    shift
    printf 'include = ["%s/cases/blast/air_copper.toml"]\n[part.rock]\n%s\n' "$root" "$line" >"$tmp/case.toml"
    for order in check run; do
        expect 2 "$order" "$tmp/case.toml"
        says err "^error: $tmp/case\.toml:3:[0-9]+: " "$@"
        silent out
    done
    [[ ! -e runs/case && ! -e $tmp/runs ]] || wrong "a broken case made a run directory"
}
broken 'spacng = "0.5 mm"' "unknown key 'spacng'" "did you mean 'spacing'" 'allowed in \[part\.NAME\]: .*spacing_far'
broken 'spacing = 0.5' 'bare number for a length' '0\.15 mm'
broken 'spacing = "0.5 us"' '0\.5 us.* is a time' 'wanted is a length'
broken 'spacing = "0.5 parsec"' 'parsec'
broken 'spacing = "-1 mm"' 'part\.rock\.spacing' '> 0'
broken 'spacing = "0.5 mm' 'not valid TOML'
broken 'material = "barre_granit"' "barre_granit'" "barre_granite"
broken 'formulation = "total_lagrange"' 'total_lagrange' 'total_lagrangian'

expect 2 check "$tmp/none.toml"
says err "none\.toml: no such file"
expect 2 check cases/blast/air_copper.toml --preset qick
says err "no preset 'qick'" "did you mean 'quick'" 'literal'
expect 2 check cases/blast/air_copper.toml --preset quick --set run.untl=3
says err "unknown key 'untl'" "did you mean 'until'"
expect 2 check cases/blast/air_copper.toml --preset quick --until "3 mm"
says err 'length' 'time'
finish
