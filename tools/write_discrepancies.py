#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write docs/discrepancies.md from python/brisance/discrepancies.json. With --check, only say whether it is up to date."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))

from brisance.discrepancies import markdown  # noqa: E402


def main(arguments):
    page = ROOT / "docs" / "discrepancies.md"
    text = markdown()
    if "--check" in arguments:
        current = page.is_file() and page.read_text(encoding="utf-8") == text
        print(f"{page.relative_to(ROOT)} is {'up to date' if current else 'out of date: run tools/write_discrepancies.py'}")
        return 0 if current else 1
    page.parent.mkdir(exist_ok=True)
    page.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
