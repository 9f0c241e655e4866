# SPDX-License-Identifier: Apache-2.0
"""The discrepancies from the paper, one data file for the report and for docs/discrepancies.md."""

import json
from pathlib import Path

FILE = Path(__file__).with_name("discrepancies.json")
HEAD = ("#", "about", "printed", "what the numbers say", "how brisance reads it")


def load():
    """{"title", "intro", "paper", "rows": [{"n", "topic", "printed", "numbers", "reading"}]}"""
    return json.loads(FILE.read_text(encoding="utf-8"))


def rows():
    """Rows of five cells of text, in the order of HEAD."""
    return [[str(r["n"]), r["topic"], r["printed"], r["numbers"], r["reading"]] for r in load()["rows"]]


def markdown():
    """The page docs/discrepancies.md."""
    data = load()
    def line(cells):
        return "| " + " | ".join(c.replace("|", "\\|") for c in cells) + " |"
    table = [line(HEAD), "|" + "---|" * len(HEAD), *map(line, rows())]
    return "\n".join([f"# {data['title']}", "", f"The paper is *{data['paper']}*. {data['intro']}", "", *table, "",
                      "This page is written by `tools/write_discrepancies.py` from `python/brisance/discrepancies.json`.", ""])
