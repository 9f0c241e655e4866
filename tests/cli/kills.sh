# SPDX-License-Identifier: Apache-2.0
# Sourced by kill.sh and kill_long.sh.

# kill_and_resume KILLS SEED: runs are killed and resumed until KILLS have struck; a run that reaches its end is compared, and another
# one begins.
kill_and_resume() {
    local wanted=$1 kills=0 writing=0 runs=0 run pid moment part
    RANDOM=$2
    (start --out "$tmp/whole" 2>"$tmp/err") || { wrong "the undisturbed run failed: $(cat "$tmp/err")"; return; }
    while ((kills < wanted && runs < wanted)); do
        runs=$((runs + 1))
        run=$tmp/run_$runs
        (start --out "$run" --set 'output.checkpoint="0.05 s"' 2>"$tmp/err") & pid=$!
        while :; do
            while [[ -z $(compgen -G "$run/checkpoints/state_?.h5") ]] && kill -0 $pid 2>/dev/null; do sleep 0.02; done
            if ((kills < wanted)); then
                moment=$((RANDOM % 60))
                if ((RANDOM % 2)); then  # at a moment of the clock, or as soon after it as something is half written
                    sleep "$(printf '0.%03d' $((10 * moment)))"
                else
                    sleep "$(printf '0.%03d' "$moment")"
                    while [[ -z $(compgen -G "$run/*/*.part") ]] && kill -0 $pid 2>/dev/null; do :; done
                fi
                kill -KILL $pid 2>/dev/null && kills=$((kills + 1))
            fi
            wait $pid 2>/dev/null && break
            part=$(compgen -G "$run/*/*.part") && [[ -n $part ]] && writing=$((writing + 1))
            if [[ -z $(compgen -G "$run/checkpoints/state_?.h5") ]]; then wrong "run $runs: no checkpoint is left, $(cat "$tmp/err")"; return; fi
            "$BRISANCE" resume "$run" --no-report --quiet 2>"$tmp/err" & pid=$!
        done
        same "$run" "run $runs, after $kills kills"
        [[ ! -s $tmp/err ]] || wrong "run $runs says: $(cat "$tmp/err")"
        rm -rf -- "$run"
    done
    echo "$kills kills, $writing of them left a half-written file, $runs runs"
    ((kills == wanted)) || wrong "killed only $kills times"
    ((3 * writing >= kills || wanted < 20)) || wrong "only $writing kills struck while a file was written"
}
