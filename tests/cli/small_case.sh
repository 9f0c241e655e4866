# SPDX-License-Identifier: Apache-2.0
# Sourced after lib.sh by the tests that stop runs: a small blast, and what has to be the same after all.
small=(--set 'part.rock.shape.cylinder.radius="13 mm"' --set 'slice.layers=2' --set 'part.rock.spacing="0.5 mm"' --set 'part.rock.spacing_far="0.7 mm"'
    --set 'gauge=[{name="G",part="rock",at=["6 mm","0 mm","100 mm"]}]'
    --set 'output.snapshots="0.5 us"' --set 'output.history="0.02 us"' --set 'analysis.zones=["0 mm","6 mm","13 mm"]' --no-report --quiet)

# start ARGUMENTS: a run in a process of its own, so that a signal finds the program.
start() { exec "$BRISANCE" run "$root/cases/blast/air_copper.toml" --preset quick --until "${until:-1.5 us}" "${small[@]}" "$@"; }

# last_state RUN: the checksum of the state in its newest checkpoint.
last_state() {
    /usr/bin/python3 - "$1" <<'PY'
import glob, h5py, sys
notes = [dict(h5py.File(f, "r").attrs) for f in glob.glob(sys.argv[1] + "/checkpoints/state_?.h5")]
print(max(notes, key=lambda n: int(n["number"]))["checksum"])
PY
}

# same RUN WHAT: it ended as $tmp/whole did.
same() {
    local f
    for f in audit.csv history.csv gauges/G.csv analysis/analysis.json analysis/section_slice.csv snapshots/fields.vtkhdf.series snapshots/fields_0001.vtkhdf; do
        cmp -s "$tmp/whole/$f" "$1/$f" || wrong "$2: $f differs from that of the undisturbed run"
    done
    [[ $(last_state "$1") == $(last_state "$tmp/whole") ]] || wrong "$2: the last state differs from that of the undisturbed run"
}
