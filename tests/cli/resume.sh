#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Stop a run and go on, by every way a run can stop: what it leaves behind is what the undisturbed run leaves, byte for byte.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

settings=(--set 'part.rock.shape.cylinder.radius="13 mm"' --set 'gauge=[{name="G",part="rock",at=["6 mm","0 mm","100 mm"]}]'
    --set 'output.snapshots="0.5 us"' --set 'output.history="0.02 us"' --set 'analysis.zones=["0 mm","6 mm","13 mm"]' --no-report --quiet)
# in a process of its own, so that a signal finds the program
start() { exec "$BRISANCE" run "$root/cases/blast/air_copper.toml" --preset quick --until "1.5 us" "${settings[@]}" "$@"; }
same() {  # same RUN what
    local f
    for f in audit.csv history.csv gauges/G.csv analysis/analysis.json analysis/section_slice.csv snapshots/fields.vtkhdf.series; do
        cmp -s "$tmp/whole/$f" "$1/$f" || wrong "$2: $f differs from that of the undisturbed run"
    done
    [[ $(checksum "$1") == $(checksum "$tmp/whole") ]] || wrong "$2: the last state differs from that of the undisturbed run"
}
checksum() {
    /usr/bin/python3 - "$1" <<'PY'
import glob, h5py, sys
notes = [dict(h5py.File(f, "r").attrs) for f in glob.glob(sys.argv[1] + "/checkpoints/state_*.h5")]
print(max(notes, key=lambda n: int(n["number"]))["checksum"])
PY
}

(start --out "$tmp/whole" --hash-every 20 2> "$tmp/err") || wrong "the undisturbed run failed: $(cat "$tmp/err")"
grep -q 'state [0-9a-f]\{16\}' "$tmp/whole/log.txt" || wrong "--hash-every wrote no hash"

# other threads, the same bits
(start --out "$tmp/one" --threads 1 2> /dev/null) || wrong "the run with one thread failed"
same "$tmp/one" "one thread"

# a polite stop: exit 5, the checkpoint of the very step
start --out "$tmp/polite" 2> "$tmp/err" & pid=$!
while [[ $(cat "$tmp/polite/audit.csv" 2> /dev/null | wc -l) -lt 30 ]] && kill -0 $pid 2> /dev/null; do sleep 0.05; done
kill -TERM $pid; wait $pid; code=$?
[[ $code == 5 ]] || wrong "SIGTERM: exit code $code, not 5"
expect 0 resume "$tmp/polite" --no-report --quiet
same "$tmp/polite" "SIGTERM and resume"

# killed six times, each a random moment after a checkpoint, with checkpoints written all the time; then left alone
newest() { stat -c %Y.%i "$tmp/killed/checkpoints/"state_?.h5 2> /dev/null | sort | tr '\n' ' '; }
(start --out "$tmp/killed" --set 'output.checkpoint="0.1 s"' 2> "$tmp/err") & pid=$!
kills=0
while ((kills < 6)); do
    before=$(newest)
    while [[ $(newest) == "$before" ]] && kill -0 $pid 2> /dev/null; do sleep 0.02; done
    sleep "0.0$((RANDOM % 10))"
    kill -KILL $pid 2> /dev/null && kills=$((kills + 1))
    wait $pid 2> /dev/null; code=$?
    ((code == 0)) && break
    "$BRISANCE" resume "$tmp/killed" --no-report --quiet 2> "$tmp/err" & pid=$!
done
wait $pid 2> /dev/null || wrong "after $kills kills the run did not come to its end: $(cat "$tmp/err")"
((kills >= 3)) || wrong "killed only $kills times: the test tested nothing"
same "$tmp/killed" "killed $kills times"

# a damaged checkpoint is refused with the reason; --older goes on from the other one
newest=$(ls -t "$tmp/killed/checkpoints/"*.h5 | head -1)
/usr/bin/python3 - "$newest" <<'PY'
import h5py, sys
with h5py.File(sys.argv[1], "r+") as f:
    f["rock.pressure"][3] += 1e-9
PY
expect 4 resume "$tmp/killed" --no-report --quiet
says err 'checksum' '--older'
expect 0 resume "$tmp/killed" --older --no-report --quiet
same "$tmp/killed" "--older"

# another case, no run, a cut file
sed -i 's/^until = "1.5 us"/until = "2.5 us"/' "$tmp/polite/case.toml"
expect 4 resume "$tmp/polite" --no-report --quiet
says err 'its case is [0-9a-f]{16}, here it is [0-9a-f]{16}'
expect 2 resume "$tmp/nowhere"
says err 'is not the folder of a run'
for f in "$tmp/one/checkpoints/"*.h5; do truncate -s 1000 "$f"; done
expect 4 resume "$tmp/one"
says err 'truncated|not HDF5|cannot'
finish
