#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Instructions that the loops of a step take, counted by valgrind on small bodies and held against tests/instructions.json.

    tools/instructions.py             exit code 1 where a loop takes over 5 % more than is on record
    tools/instructions.py --accept    what is counted now is the record; say in the commit why it grew

The program is that of the preset portable, since valgrind knows no AVX-512, and one compiler's numbers say nothing of another's. Exit code 77:
no valgrind, or another compiler than the record's. Half a minute, the build not counted.
"""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RECORD = ROOT / "tests" / "instructions.json"
MARGIN = 0.05
LOOPS = ("rock", "copper", "fluid", "contact")


def build():
    """The loops of tests/instructions/loops.cpp in the preset portable, and the compiler that made them."""
    for command in (["cmake", "--preset", "portable", "-DBRISANCE_TESTS=ON", "-DBRISANCE_UNIT_TESTS=none"], ["cmake", "--build", "--preset", "portable", "--target", "loops"]):
        subprocess.run(command, cwd=ROOT, check=True, stdout=sys.stderr)
    cache = (ROOT / "build/portable/CMakeCache.txt").read_text()
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.M)[1]
    return ROOT / "build/portable/loops", subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]


def count(program, loop, folder):
    """Instructions inside `counted`, all that it calls included."""
    trace = folder / f"{loop}.callgrind"
    done = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=counted*", f"--callgrind-out-file={trace}", str(program), loop], capture_output=True, text=True)
    total = re.search(r"^(?:summary|totals): (\d+)", trace.read_text() if trace.exists() else "", re.M)
    if done.returncode != 0 or not total or int(total[1]) == 0:
        sys.exit(f"{loop}: nothing was counted (exit code {done.returncode})\n{done.stdout}{done.stderr[-2000:]}")
    return int(total[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accept", action="store_true", help="write what is counted to tests/instructions.json")
    accept = parser.parse_args().accept
    if not shutil.which("valgrind"):
        print("valgrind is not here; on Debian: apt install valgrind")
        return 77
    program, compiler = build()
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    if not accept and record.get("compiler") != compiler:
        print(f"the record is of {record.get('compiler')}, this is {compiler}: nothing to compare")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        now = {loop: count(program, loop, Path(folder)) for loop in LOOPS}
    if accept:
        RECORD.write_text(json.dumps({"compiler": compiler, **now}, indent=2) + "\n")
        print(f"{RECORD}: {now}")
        return 0
    failed = 0
    for loop, n in now.items():
        change = n / record[loop] - 1
        over = change > MARGIN
        failed += over
        print(f"{loop:8} {n:>14,} instructions, {100 * change:+.1f} % of the record{'  TOO MANY' if over else ''}")
    if failed:
        print("if that is meant: tools/instructions.py --accept, and say in the commit what it buys")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
