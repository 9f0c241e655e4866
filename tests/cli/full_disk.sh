#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The disk fills up, is read-only, goes away; memory runs out: exit code 4, a message that names what and where, and the last good
# checkpoint still there, from which the run goes on to the same end. fault.c makes the system calls fail; no privileges are needed.
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/small_case.sh"
until="0.6 us"
command -v cc >/dev/null || { echo "no C compiler"; exit 77; }
cc -shared -fPIC -O1 -o "$tmp/fault.so" tests/cli/fault.c -ldl || { wrong "fault.c does not compile"; finish; }
if ldd "$BRISANCE" | grep -q 'lib[at]san'; then echo "a sanitizer wants to be loaded first"; exit 77; fi

(start --out "$tmp/whole" 2>"$tmp/err") || { wrong "the undisturbed run failed: $(cat "$tmp/err")"; finish; }

# A checkpoint follows every step, so that how many there are does not depend on the speed of the machine.
# fault CALLS PATH AFTER ERRNO PATTERN...: from the AFTER-th call on, calls on PATH fail; the run stops with code 4 and says so. Then the
# fault is gone, and if there was a checkpoint the run goes on from it.
fault() {
    local calls=$1 path=$2 after=$3 number=$4 run=$tmp/faulty code
    shift 4
    rm -rf -- "$run"
    command="a run in which '$calls' fails on '$path' after $after"
    (exec 2>"$tmp/err"; export LD_PRELOAD=$tmp/fault.so FAULT_CALLS=$calls FAULT_PATH=$path FAULT_AFTER=$after FAULT_ERRNO=$number
        start --out "$run" --set 'output.checkpoint="1e-3 s"' >"$tmp/out"); code=$?
    ((code == 4)) || wrong "$command: exit code $code, not 4"
    says err '^error: ' "$@"
    [[ -z $(compgen -G "$run/*/*.part") && -z $(compgen -G "$run/*.part") ]] || wrong "$command: half-written files remain: $(compgen -G "$run/*/*.part")"
    [[ -n $(compgen -G "$run/checkpoints/state_?.h5") ]] || { [[ -z ${with_checkpoint:-} ]] || wrong "$command: no checkpoint"; return; }
    "$BRISANCE" resume "$run" --no-report --quiet 2>"$tmp/err" || wrong "$command: cannot go on: $(cat "$tmp/err")"
    cmp -s "$tmp/whole/audit.csv" "$run/audit.csv" || wrong "$command: audit.csv differs after the resume"
    [[ $(last_state "$run") == $(last_state "$tmp/whole") ]] || wrong "$command: the state differs after the resume"
}
with_checkpoint=
fault write case.toml 0 28 'case\.toml: cannot write: No space left on device'
fault open case.toml 0 30 'case\.toml: cannot create: Read-only file system'
fault open audit.csv 0 30 'audit\.csv: cannot create: Read-only file system'
fault mkdir faulty 0 30 'faulty: cannot prepare the folder of the run: Read-only file system'
fault write log.txt 0 28 'log\.txt: cannot write: No space left on device'
with_checkpoint=yes
fault write state_ 2500 28 'state_[01]\.h5.*No space left on device' 'brisance resume'
fault write audit.csv 25 28 'audit\.csv: cannot write: No space left on device' 'brisance resume'
fault write fields_0001 3 28 'fields_0001.*No space left on device'
fault fsync state_ 2 5 'state_[01]\.h5: cannot write: Input/output error'
fault rename state_ 2 30 'state_[01]\.h5: cannot write: Read-only file system'
fault write G.csv 20 122 'G\.csv: cannot write: Disk quota exceeded'

# a limit on the size of files, which the kernel itself imposes
rm -rf -- "$tmp/faulty"
command="a run under ulimit -f"
(trap '' XFSZ; ulimit -f 300; exec 2>"$tmp/err"; start --out "$tmp/faulty") ; code=$?
((code == 4)) || wrong "$command: exit code $code, not 4"
says err '^error: .*(state_|fields_).*File too large'

# the folder is removed under the run
(exec 2>"$tmp/err"; start --out "$tmp/gone" >"$tmp/out") & pid=$!
while [[ $(cat "$tmp/gone/audit.csv" 2>/dev/null | wc -l) -lt 5 ]] && kill -0 $pid 2>/dev/null; do sleep 0.05; done
while ! rm -rf -- "$tmp/gone" 2>/dev/null; do :; done
wait $pid; code=$?
command="a run whose folder is removed"
((code == 4)) || wrong "$command: exit code $code, not 4"
says err 'error: .*gone/.*: (was removed while it was written|cannot create|cannot write).*No such file or directory|error: .*gone/.*No such file'

# no folder can be made there
touch "$tmp/file"
expect 4 run cases/blast/air_copper.toml --preset quick --out "$tmp/file/run"
says err 'file/run: cannot .*Not a directory'
expect 4 run cases/blast/air_copper.toml --preset quick --out /proc/brisance
says err '/proc/brisance: cannot prepare the folder of the run'

# memory: refused beforehand where the estimate tells, else stopped with the same code wherever it runs out
for limit in 150000 220000 300000; do
    command="a run with $limit kB of memory"
    (ulimit -v $limit; OMP_NUM_THREADS=2 exec "$BRISANCE" run cases/blast/air_copper.toml --preset quick --until "1 us" --no-report --quiet --out "$tmp/mem_$limit" >"$tmp/out" 2>"$tmp/err"); code=$?
    ((code == 4)) || wrong "$command: exit code $code, not 4"
    says err '^error: .*(out of memory|does not fit)'
done
finish
