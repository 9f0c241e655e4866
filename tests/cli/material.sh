#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# One point of a material on the command line: table, CSV, JSON, figure, a path file, and what is refused.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

expect 0 material alumina_jh94_c --steps 2000
silent err
says out 'alumina_jh94_c, uniaxial_strain: 4000 steps' 'damage' 'bulking'
# the bulking pressure of case C, published 0.65 GPa
awk 'END { exit !($NF > 0.645 && $NF < 0.655) }' "$tmp/out" || wrong "bulking of case C: $(tail -n 1 "$tmp/out")"

expect 0 material barre_granite --path triaxial --confinement "10 MPa" --confinement "50 MPa" --csv "$tmp/t.csv" --plot "$tmp/t.png"
[[ $(cut -d, -f1,2 "$tmp/t.csv" | grep -c 'triaxial, 50 MPa') -gt 100 ]] || wrong "no rows of the second confinement"
[[ $(head -c 4 "$tmp/t.png" | tail -c 3) == PNG ]] || wrong "no figure"
expect 0 material petn_1320 --path release --json
/usr/bin/python3 -c 'import json, sys; d = json.load(open(sys.argv[1])); assert abs(d["paths"][0]["shock_speed"][1] - 6.7405) < 1e-3, d' "$tmp/out" || wrong "no CJ speed in the JSON"

printf '[[leg]]\npressure = "0.2 GPa"\n[[leg]]\npressure = "0 GPa"\n' > "$tmp/path.toml"
expect 0 material water --path "$tmp/path.toml"
says out 'water, path: 2000 steps'
printf '[[leg]]\npresure = "0.2 GPa"\n' > "$tmp/path.toml"
expect 2 material water --path "$tmp/path.toml"
says err 'path.toml:2:1' "did you mean 'pressure'"
expect 2 material water --path "$tmp/none.toml"
says err 'none.toml'
expect 2 material watr
says err "no material 'watr'"
expect 2 material water --path shok
says err "did you mean 'shock'"
expect 2 material water --path shock --velocity "3 mm"
says err 'velocity'
expect 2 material water --path hydrostatic --confinement "3 MPa"
says err 'triaxial only'
expect 2 material water --path shock --steps 0
finish
