#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Registers, stack and spills of every kernel, as ptxas counts them, and the table of docs/gpu.md.

    tools/kernel_registers.py [--arch sm_90]     print the table
    tools/kernel_registers.py --docs             write it into docs/gpu.md

Needs nvcc and a configured build/cuda (cmake --preset cuda). Exit code 1 if a kernel of the hot path spills in single precision. Four minutes.
"""

import argparse
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "gpu.md"
BEGIN, END = "<!-- kernels: tools/kernel_registers.py --docs -->", "<!-- end of kernels -->"
HOT = ("StressKernel", "KickKernel", "DriftKernel", "SearchKernel", "DivergenceKernel", "RatesKernel", "NodeKernel", "WallKernel", "ReactionKernel", "FollowKernel")


def sources():
    """Commands of the files that go through nvcc."""
    for entry in json.loads((ROOT / "build/cuda/compile_commands.json").read_text()):
        if "nvcc" in entry["command"].split()[0]:
            yield entry["file"], entry["command"], entry["directory"]


def compile_for(arch, command, directory):
    """What ptxas says while it compiles one file for one architecture."""
    words, kept, skip = shlex.split(command), [], False
    for word in words:
        if skip or word.startswith("--generate-code") or word.startswith("-arch"):
            skip = False
            continue
        if word in ("-o", "-MF", "-MT"):
            skip = True
            continue
        if word in ("-MD", "-c"):
            continue
        kept.append(word)
    done = subprocess.run(kept + ["-cubin", f"-arch={arch}", "-Xptxas=-v", "-o", "/dev/null"], cwd=directory, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr[-3000:])
    return done.stderr


def kernels(text):
    """(mangled name, registers, stack bytes, spilled bytes)"""
    for part in text.split("Compiling entry function '")[1:]:
        name = part.split("'", 1)[0]
        stack, stores, loads = (int(re.search(rf"(\d+) bytes {what}", part)[1]) for what in ("stack frame", "spill stores", "spill loads"))
        yield name, int(re.search(r"Used (\d+) registers", part)[1]), stack, stores + loads


def short(name):
    """The kernel's own name and parameters, without the loop that runs it; None for those of libraries, lambdas and what selection adds."""
    if "cub" in name and "brisance" not in name.split("cub", 1)[0] or "thrust::" in name:
        return None
    name = re.sub(r"\(anonymous namespace\)::|_GLOBAL__N__\w+::|_NV_ANON_NAMESPACE::|brisance::|exec::|cuda::", "", name)
    found = re.search(r"(?:run_kernel|sum_kernel)<(.*)>\(", name)
    if not found or "__nv_" in found[1] or "lambda" in found[1] or found[1].startswith(("Entry", "Flag", "Put")) or ", Entry<" in found[1]:
        return None
    inner = found[1]
    if inner.startswith(("StressSums, ", "BodySums, ", "double, ", "Largest, ", "FluidSolver::Powers, ", "Touched, ", "Box, ", "Extent, ", "Total, ", "Census, ", "long, ")):
        inner = inner.split(", ", 1)[1]
    inner = re.sub(r"TypedLaws<(\w+) ?>", r"\1", inner)
    return re.sub(r"LargestOf<(.*)>", r"\1", inner).replace(" >", ">").strip()


def table(arch):
    with ThreadPoolExecutor(2) as pool:
        texts = list(pool.map(lambda s: compile_for(arch, s[1], s[2]), sources()))
    raw = [row for text in texts for row in kernels(text)]
    names = subprocess.run(["c++filt"], input="\n".join(row[0] for row in raw), capture_output=True, text=True, check=True).stdout.splitlines()
    rows = {short(name): row[1:] for name, row in zip(names, raw) if short(name)}
    lines = [f"| kernel, {arch} | registers | stack, bytes | spilled, bytes |", "|---|---|---|---|"]
    lines += [f"| `{name}` | {r} | {stack} | {spill} |" for name, (r, stack, spill) in sorted(rows.items())]
    others = [row[1:] for name, row in zip(names, raw) if not short(name) and "brisance" in name]
    lines.append("| lambdas and selections, at most | " + " | ".join(str(max(row[k] for row in others)) for k in range(3)) + " |")
    bad = [name for name, (_, _, spill) in rows.items() if spill and name.startswith(HOT) and "double" not in name]
    return lines, bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arch", default="sm_90")
    parser.add_argument("--docs", action="store_true", help="write the table into docs/gpu.md")
    options = parser.parse_args()
    lines, bad = table(options.arch)
    if options.docs:
        text = PAGE.read_text(encoding="utf-8")
        head, rest = text.split(BEGIN)
        PAGE.write_text(head + BEGIN + "\n\n" + "\n".join(lines) + "\n\n" + END + rest.split(END)[1], encoding="utf-8")
    else:
        print("\n".join(lines))
    for name in bad:
        print(f"{name} spills in single precision", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
