#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The material library on the command line: all of it, one material with the source of each number, a name that does not exist.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

expect 0 materials
silent err
listed=$(sed -nE 's/^([a-z0-9_]+) +[0-9.]+ kg\/m3 +[0-9]+ m\/s .*/\1/p' "$tmp/out" | sort)
files=$(find materials -name '*.toml' -printf '%f\n' | sed 's/\.toml$//' | sort)
[[ $listed == "$files" ]] || wrong "not listed: $(comm -13 <(printf '%s\n' "$listed") <(printf '%s\n' "$files") | xargs)"

expect 0 materials --json
/usr/bin/python3 -c 'import json, sys; assert len(json.load(open(sys.argv[1]))) > 10' "$tmp/out" 2>/dev/null || wrong "materials --json is no JSON list"

/usr/bin/python3 - "$tmp/out" <<'END' || wrong "materials --json lacks source, confidence or checks"
import json, sys
rows = {r["name"]: r for r in json.load(open(sys.argv[1]))}
assert all(r["source"] and r["confidence"] and r["checks"] for r in rows.values())
assert rows["hmx"]["checks"] == "1 warning" and any("miss the stated CJ" in x for x in rows["hmx"]["remarks"])
END
expect 0 materials --full
says out '^hmx .* 1 warning' 'check: warning: the products miss' 'source: all constants as stated in the paper'

expect 0 materials barre_granite
says out '^barre_granite: ' 'strength: jh2' '^ +HEL +[0-9.]+ GPa' 'bulk modulus [0-9.]+ GPa'
expect 2 materials barre_granit
says err "no material 'barre_granit'" 'barre_granite'
finish
