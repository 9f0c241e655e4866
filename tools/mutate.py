#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Break the program on purpose, one sign or factor at a time, and see which verification case notices.

    /usr/bin/python3 tools/mutate.py [MUTANT ...] [--folder DIR] [--every] [--docs] [--list]

The sources are copied to DIR (default build/mutants) and built there; the working tree is not touched. Each mutant is one replacement in one
file. Cases of the quick lane run until one misses a bound, in the order that the mutant names; with --every all cases of the quick lane run. With --docs the table goes into docs/verification/mutants.md.
Exit codes: 0 every mutant was caught, 1 one was not, 2 bad input.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FLUID, FORCES, STRESS = (f"src/formulations/{f}" for f in ("updated_lagrangian/fluid.cpp", "total_lagrangian/forces.cpp", "total_lagrangian/stress.cpp"))

# name: what is wrong, file, right text, wrong text, cases to try first
MUTANTS = {
    "viscosity_sign": ("pairwise viscosity drives instead of damping", FLUID, "2.0 * mu * (beta * mu - alpha * (0.5", "-2.0 * mu * (beta * mu - alpha * (0.5",
                       ("strong_shock", "sod")),
    "viscous_heat_doubled": ("the missing 1/2 in the energy of a pair", FLUID, "heat -= 0.5 * bracket * wv;", "heat -= bracket * wv;", ("strong_shock", "sod")),
    "pressure_work_halved": ("half of P dV in the energy of a fluid", FLUID, "(b.pressure[i] + w.q[i]) / rho * b.rho_rate[i] + s[3]",
                             "0.5 * (b.pressure[i] + w.q[i]) / rho * b.rho_rate[i] + s[3]", ("jwl_release", "sod")),
    "mirror_velocity": ("a mirror image moves as its particle does", FLUID, "sign(k, 0) * b.v_now[0][i]", "b.v_now[0][i]", ("water_hugoniot",)),
    "lit_early": ("the detonation runs a tenth too fast", FLUID, "d.time + distance / speed", "d.time + distance / (1.1 * speed)", ("detonation",)),
    "burn_energy": ("the energy of fluids is 1.1 times what it should be", "src/app/assembly.cpp", "const double e0 = b.material.eos->initial_energy() / b.material.density;",
                    "const double e0 = 1.1 * b.material.eos->initial_energy() / b.material.density;", ("detonation", "jwl_release")),
    "jwl_sign": ("the second exponential of JWL counts against the first", "src/laws/eos/jwl.h", "(R(1) - q1) * e1 + (R(1) - q2) * e2,", "(R(1) - q1) * e1 - (R(1) - q2) * e2,",
                 ("jwl_release", "detonation")),
    "transposed_F": ("the first Piola stress with the transpose of F", STRESS, "(sigma * cof) * k_inverse", "(sigma * transpose(cof)) * k_inverse", ("spinning_disc",)),
    "dropped_K": ("the force without the inverse of K", STRESS, "(sigma * cof) * k_inverse", "(sigma * cof)", ("plane_waves",)),
    "shear_modulus": ("G in place of 2 G in the elastic law", "src/laws/strength/elastic.h", "elastic_trial(p, R(2 * G))", "elastic_trial(p, R(G))", ("plane_waves",)),
    "control_sign": ("the zero-energy control pushes the wrong way", FORCES, "kx += spring * dx;", "kx -= spring * dx;", ("plane_waves", "cavity")),
    "load_inward": ("the pressure on a wall pulls", "src/boundary/boundary.cpp", "load[n] = (-pressure * s.area[i]) * area;", "load[n] = (pressure * s.area[i]) * area;", ("cavity",)),
    "strength_of_compression": ("a particle breaks in compression in place of tension", STRESS, "(one_now > R(rule.tensile) * p.scale)", "(-one_now > R(rule.tensile) * p.scale)", ("spall",)),
    "no_reaction": ("contact pushes the node and not the wall", "src/contact/wall_contact.cpp", "wall.f[0][j] -= hsum(f.x);", "wall.f[0][j] -= 0 * hsum(f.x);", ("rings", "contact_pulse")),
    "artificial_stress_sign": ("the artificial stress attracts", FLUID, "const V extra = -resistance", "const V extra = resistance", ("liquid_under_tension",)),
    "images_at_rest": ("neighbours beyond the period stand still at the start", "src/integrate/step.cpp", "complete(s.body);", "", ("rings",)),
}


PAGE = """<!-- SPDX-License-Identifier: Apache-2.0 -->
# A broken program is caught

A verification that cannot fail shows nothing. `/usr/bin/python3 tools/mutate.py --docs` breaks the program on purpose, one sign or factor at a time, builds it, and runs the quick lane
until a case misses a bound; this is its table. [All cases](index.md)

| what is wrong | where | caught by (error, bound) |
|---|---|---|"""


def command(*words, **options):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True, **options)


def prepare(folder):
    """A copy of the tracked files, and its build."""
    tree = folder / "tree"
    if tree.exists():
        shutil.rmtree(tree)
    for name in command("git", "ls-files", "-co", "--exclude-standard", cwd=ROOT, check=True).stdout.splitlines():
        if (ROOT / name).is_file() and not name.startswith(("docs/", "tests/")):
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, tree / name)
    done = command("cmake", "-S", tree, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBRISANCE_TESTS=OFF")
    if done.returncode:
        raise SystemExit(done.stderr)
    return tree


def build(folder):
    done = command("cmake", "--build", folder / "build", "--target", "brisance", "-j", os.cpu_count() or 1)
    return "" if done.returncode == 0 else (done.stdout + done.stderr)[-2000:]


def verify(folder, tree, case):
    """What a case misses: "quantity (run)" of the first bound, or "" where it is content."""
    out = folder / "runs"
    environment = {**os.environ, "BRISANCE_HOME": str(tree)}
    done = command(folder / "build" / "brisance", "verify", case, "--json", "--out", out, env=environment)
    if done.returncode == 0:
        return ""
    if done.returncode != 1:
        raise SystemExit(f"brisance verify {case}: exit code {done.returncode}: {done.stderr}")
    result = json.loads(done.stdout)["cases"][0]
    for row in result["rows"]:
        if row["verdict"] == "MISSED":
            return f"{row['quantity']} ({row['run']}: {row['error']:+.2g}, bound {row['bound']:g})"
    for entry in result["failed"]:
        return f"run {entry['run']} is stopped: {entry['problem'].split(' (')[0].split(', held')[0][:80]}"
    return next(f"order of {o['quantity']} ({o['order']:.2f})" for o in result["orders"] if o["verdict"] == "MISSED")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mutants", metavar="MUTANT", nargs="*")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "mutants")
    parser.add_argument("--every", action="store_true", help="run all cases of the quick lane against each mutant")
    parser.add_argument("--docs", action="store_true", help="write docs/verification/mutants.md; needs all mutants")
    parser.add_argument("--list", action="store_true", help="name the mutants, build nothing")
    options = parser.parse_args()
    unknown = [m for m in options.mutants if m not in MUTANTS]
    if unknown:
        parser.error(f"no mutant '{unknown[0]}'; there are: {', '.join(MUTANTS)}")
    chosen = options.mutants or list(MUTANTS)
    if options.list:
        for name in chosen:
            print(f"{name:<24} {MUTANTS[name][1]}: {MUTANTS[name][0]}")
        return 0
    folder = options.folder.resolve()
    tree = prepare(folder)
    sys.path.insert(0, str(ROOT / "python"))
    from brisance.verification import all_cases
    quick = [n for n, c in all_cases().items() if c.of_lane("quick")]
    escaped, table = 0, []
    for name in chosen:
        what, file, right, wrong, first = MUTANTS[name]
        source = (tree / file).read_text(encoding="utf-8")
        if source.count(right) != 1:
            raise SystemExit(f"{name}: {file} holds the text {right!r} {source.count(right)} times, wanted once")
        start = time.monotonic()
        (tree / file).write_text(source.replace(right, wrong), encoding="utf-8")
        try:
            problem = build(folder)
            if problem:
                raise SystemExit(f"{name} does not build: {problem}")
            caught = []
            for case in [*first, *(q for q in quick if q not in first)]:
                missed = verify(folder, tree, case)
                if missed:
                    caught.append(f"{case}: {missed}")
                    if not options.every:
                        break
        finally:
            (tree / file).write_text(source, encoding="utf-8")
        escaped += not caught
        table.append(f"| {what} | `{file}` | {'; '.join(caught) if caught else '**not caught**'} |")
        print(f"{name:<24} {'caught by ' + '; '.join(caught) if caught else 'NOT CAUGHT'}   [{what}; {time.monotonic() - start:.0f} s]", flush=True)
    print(f"{len(chosen) - escaped} of {len(chosen)} caught")
    if options.docs and chosen == list(MUTANTS):
        (ROOT / "docs" / "verification" / "mutants.md").write_text("\n".join([PAGE, *table, ""]), encoding="utf-8")
    return 1 if escaped else 0


if __name__ == "__main__":
    sys.exit(main())
