#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Stop a run and go on, by every way a run can stop: what it leaves behind is what the undisturbed run leaves, byte for byte.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

source "$(dirname -- "${BASH_SOURCE[0]}")/small_case.sh"

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

# a run that is at its end can go further, and more than once; what the provenance says of the run stays
expect 0 resume "$tmp/polite" --until "1.6 us" --no-report --quiet
expect 0 resume "$tmp/polite" --until "1.7 us" --no-report --quiet
expect 2 resume "$tmp/polite" --until "1 us"
says err 'stands at t = 1\.7.* us already'
/usr/bin/python3 - "$tmp/polite/provenance.json" <<'PY' || wrong "the provenance of a resumed run"
import json, sys
p = json.load(open(sys.argv[1]))
assert p["case_file"].endswith("cases/blast/air_copper.toml") and p["preset"] == "quick" and len(p["settings"]) >= 8, p
assert " run " in p["command"] and p["status"] == "finished" and len(p["resumed"]) == 3, p
assert [round(r["from_us"], 6) for r in p["resumed"][1:]] == [1.5, 1.6], p["resumed"]
PY
[[ $(tail -n 1 "$tmp/polite/audit.csv" | cut -d, -f2 | cut -c1-3) == 1.7 ]] || wrong "the longer run did not reach 1.7 us"

# two processes in one folder
start --out "$tmp/held" --set 'output.checkpoint="0.1 s"' 2> "$tmp/err" & pid=$!
while [[ ! -e $tmp/held/checkpoints/state_1.h5 ]] && kill -0 $pid 2> /dev/null; do sleep 0.05; done
expect 4 resume "$tmp/held"
says err 'held: another brisance runs in this folder'
expect 4 run cases/blast/air_copper.toml --preset quick --out "$tmp/held" --overwrite
says err 'held: another brisance runs in this folder'
kill -USR1 $pid
wait $pid || wrong "the run in a folder that others wanted did not end well: $(cat "$tmp/err")"
same "$tmp/held" "wanted by others"

# the library changes between the two: the case carries its materials
cp -r materials "$tmp/library"
start --out "$tmp/library_run" 2> "$tmp/err" & pid=$!
while [[ $(cat "$tmp/library_run/audit.csv" 2> /dev/null | wc -l) -lt 20 ]] && kill -0 $pid 2> /dev/null; do sleep 0.05; done
kill -TERM $pid; wait $pid
sed -i 's/"57 MPa"/"5 MPa"/' "$tmp/library/barre_granite.toml"
cmp -s materials/barre_granite.toml "$tmp/library/barre_granite.toml" && wrong "the library did not change: the test tests nothing"
BRISANCE_MATERIALS=$tmp/library expect 0 resume "$tmp/library_run" --no-report --quiet
same "$tmp/library_run" "another library"

# a damaged checkpoint is refused with the reason; --older goes on from the other one
newest=$(ls -t "$tmp/held/checkpoints/"*.h5 | head -1)
/usr/bin/python3 - "$newest" <<'PY'
import h5py, sys
with h5py.File(sys.argv[1], "r+") as f:
    f["rock.pressure"][3] += 1e-9
PY
expect 4 resume "$tmp/held" --no-report --quiet
says err 'checksum' '--older'
expect 0 resume "$tmp/held" --older --no-report --quiet
same "$tmp/held" "--older"

# another case, no run, a cut file
sed -i 's/^until = "1.5 us"/until = "2.5 us"/' "$tmp/library_run/case.toml"
cp "$tmp/library_run/provenance.json" "$tmp/before.json"
expect 4 resume "$tmp/library_run" --no-report --quiet
cmp -s "$tmp/before.json" "$tmp/library_run/provenance.json" || wrong "a refused resume changed the provenance"
says err 'belongs to another case: .*case.toml is not what it was'
expect 2 resume "$tmp/nowhere"
says err 'is not the folder of a run'
for f in "$tmp/one/checkpoints/"*.h5; do truncate -s 1000 "$f"; done
expect 4 resume "$tmp/one"
says err 'truncated|not HDF5|cannot'
finish
