# SPDX-License-Identifier: Apache-2.0
"""The loops over packs of points are vector code for every law: read off the program itself, with objdump.

A pack holds 8 doubles. Where the compiler has a vector instruction for an operation, a pack takes as many arithmetic instructions as a
single point does (twice as many where registers hold half a pack); where it fell back to single lanes it takes eight times as many.
"""

import collections
import os
import re
import shutil
import subprocess
import unittest

PROGRAM = os.environ.get("BRISANCE", "build/release/brisance")
LAW = re.compile(r"brisance::(\w+)(?:>::(update_pack|update|terms)\(|::(update|terms)<)")
ARITHMETIC = re.compile(r"v?(?:add|sub|mul|div|sqrt|max|min|f?n?m(?:add|sub)\d*|fnm(?:add|sub)\d*)(pd|sd|ps|ss)$")


def count():
    """Arithmetic instructions of each law: {(law, 'point' | 'double' | 'float'): {'p': packed, 's': scalar}}."""
    counts = collections.defaultdict(collections.Counter)
    kind = None
    out = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", "--section=.text", PROGRAM], capture_output=True, text=True, check=True)
    for line in out.stdout.splitlines():
        if line.endswith(">:"):
            law = LAW.search(line)
            kind = None
            if law and ("brisance::detail::" in line or law[3]):
                width = "double" if "double __vector" in line else "float" if "float __vector" in line else "point" if "float" not in line else None
                kind = (law[1], width) if width else None
        elif kind:
            words = line.split(":", 1)[-1].split()
            match = ARITHMETIC.match(words[0]) if words else None
            if match:
                counts[kind][match[1][0]] += 1
    return counts


@unittest.skipUnless(shutil.which("objdump"), "no objdump")
class Vectorised(unittest.TestCase):
    def test_a_pack_takes_hardly_more_instructions_than_a_point(self):
        counts = count()
        laws = sorted({law for law, _ in counts})
        if any("sanitize" in line for line in subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout.splitlines()):
            self.skipTest("not the optimised program")
        checked = 0
        for law in laws:
            point = sum(counts[law, "point"].values())
            if not point:
                continue
            for width in ("double", "float"):
                pack = counts[law, width]
                with self.subTest(law=law, width=width):
                    self.assertGreater(pack["p"], 0, "no vector instruction at all")
                    self.assertLessEqual(pack["p"] + pack["s"], 3 * point + 8, f"{dict(pack)} for a pack, {point} for a point")
                    self.assertLessEqual(pack["s"], 0.34 * pack["p"] + 12, "single lanes")
                    checked += 1
        self.assertGreaterEqual(checked, 2 * 8, laws)


if __name__ == "__main__":
    unittest.main()
