#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# What a case will need: every case of cases/blast in its quick preset, from any folder, for people and for programs. A case that does
# not fit is exit code 4 and names the memory.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

for case in air_copper water_copper air water; do
    expect 0 check "cases/blast/$case.toml" --preset quick
    says out '^rock +barre_granite +total_lagrangian' '^charge +petn_1320 ' 'particles, .* GiB \(free: ' 'first step [0-9.]+ ns'
    silent err
done

cd "$tmp" || exit 1
expect 0 check "$root/cases/blast/air_copper.toml" --preset quick --json --threads 1
/usr/bin/python3 - "$tmp/out" <<'PY' || wrong "check --json"
import json, sys
case = json.load(open(sys.argv[1]))
parts = {part["name"]: part for part in case["parts"]}
assert list(parts) == ["rock", "copper", "coupling", "sheath", "charge"], list(parts)
assert abs(sum(part["particles"] for part in parts.values()) - case["particles"]) <= len(parts)
assert case["dt_us"] == min(part["dt_us"] for part in parts.values())
assert case["fits"] is True and case["bytes"] > 0 and case["steps"] > 0
# pi (72^2 - 3.225^2) mm2 x 6 layers of 0.4 mm x 2.66 mg/mm3 = 103.76 g; 1 % for the density of another set
assert abs(parts["rock"]["mass_mg"] / 103.76e3 - 1) < 0.01, parts["rock"]
PY
[[ -z $(find . -mindepth 1 ! -name out ! -name err) ]] || wrong "check left files behind"

for order in check run; do
    expect 4 "$order" "$root/cases/blast/air_copper.toml" --preset literal --set part.rock.spacing_z='"0.015 mm"'  # 7.2e9: no machine has this
    says err '[0-9.e+]+ GiB for 7\.[0-9]*e\+09 particles' '[0-9.e+]+ GiB (are )?free'
done
available=$(sed -n 's/^MemAvailable: *\([0-9]*\) kB/\1/p' /proc/meminfo)
if ((available < 200 * 1024 * 1024)); then
    expect 4 check "$root/cases/blast/air_copper.toml" --preset literal
    says err 'needs about [0-9.]+ GiB for 7\.[0-9]+e\+08 particles' 'GiB are free'
fi
finish
