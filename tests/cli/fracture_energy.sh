#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A fracture energy in a case: what a run says of it, and what is refused with its place. A block of granite is pulled apart.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

case_with() {  # spacing tensile_strength more...
    cat > "$tmp/case.toml" <<END
parts = ["rock"]
[run]
until = "1 us"
precision = "double"
[part.rock]
material = "barre_granite"
formulation = "total_lagrangian"
shape.box = { min = ["0 mm", "0 mm", "0 mm"], max = ["8 mm", "4 mm", "4 mm"] }
spacing = "$1"
arrangement = "lattice"
viscosity.bulk = { linear = 0.06, quadratic = 1.5 }
failure = { tensile_strength = "$2", fracture_energy = "60 J/m2"${3:+, $3} }
END
}

case_with "0.5 mm" "10 MPa"
expect 0 run "$tmp/case.toml" --out "$tmp/run" --no-report
says err 'cracks dissipate 60 J/m2 over a band of 1.1 mm, from 10 MPa on \(snap-back from 61.4 mm on\)'

case_with "0.5 mm" "100 MPa"
expect 2 run "$tmp/case.toml" --out "$tmp/run2" --no-report
says err 'case.toml:[0-9]+:[0-9]+.*fracture_energy' 'snaps back' 'Allowed: a spacing up to 0.279 mm'
[[ ! -e $tmp/run2/history.csv ]] || wrong "a refused run left a history"

case_with "0.1 mm" "108 MPa"
expect 2 run "$tmp/case.toml" --out "$tmp/run3" --no-report
says err 'fracture_energy' 'fails by itself at 1[01][0-9]\.[0-9] MPa in uniaxial tension'

case_with "0.5 mm" "10 MPa" 'mode = "all_zero"'
expect 2 check "$tmp/case.toml"
says err 'mode = "jh2" only'
sed -i '/failure = /s/.*/failure = { fracture_energy = "60 J\/m2" }/' "$tmp/case.toml"
expect 2 check "$tmp/case.toml"
says err 'needs the stress at which cracks begin'
sed -i '/failure = /s/.*/failure = { tensile_strength = "10 MPa", fracture_energy = "60 MPa" }/' "$tmp/case.toml"
expect 2 check "$tmp/case.toml"
says err 'fracture_energy' 'is a pressure'
finish
