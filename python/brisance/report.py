#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write the report of one run, or of several side by side, as one self-contained HTML page.

    report.py RUN [RUN ...] [--out FILE] [--no-pdf]

Without --out the page is RUN/report.html, or comparison/report.html for several runs; the figures lie next to it in
figures/, as PNG and PDF. Exit codes: 0 written, 2 bad input, 4 a Python module is missing or the disk refuses.
"""

import sys
from pathlib import Path

if not __package__:  # run as a script: let `brisance` be found, and none of its modules hide one of the standard library
    sys.path[0] = str(Path(__file__).resolve().parents[1])

from brisance import needs  # noqa: E402

EXIT_OK, EXIT_BAD_INPUT, EXIT_RESOURCES = 0, 2, needs.EXIT_RESOURCES


def _arguments(argv):
    import argparse
    parser = argparse.ArgumentParser(prog="brisance report", description="Write the report of one or several runs as one HTML page.")
    parser.add_argument("runs", metavar="RUN", nargs="+", help="a run directory; several are compared")
    parser.add_argument("--out", metavar="FILE", type=Path, help="the page (default: RUN/report.html, or comparison/report.html)")
    parser.add_argument("--no-pdf", action="store_true", help="write the figures as PNG only (quicker)")
    return parser.parse_args(argv)


def write(paths, out=None, pdf=True):
    """Write the page and its figures; the path of the page. Raises BadRun or OSError."""
    from brisance import figures, page
    from brisance.run import BadRun, Run
    resolved = [Path(p).resolve() for p in paths]
    if len(set(resolved)) < len(resolved):
        raise BadRun("the same run directory is given twice")
    runs = [Run(p) for p in paths]
    out = out or (runs[0].path / "report.html" if len(runs) == 1 else Path("comparison") / "report.html")
    if out.suffix.lower() not in (".html", ".htm"):
        raise BadRun(f"--out {out}: the page must be named *.html")
    out.parent.mkdir(parents=True, exist_ok=True)
    drawn = figures.draw(runs, out.parent / "figures", pdf)
    out.write_text(page.page(runs, drawn), encoding="utf-8")
    return out


def main(argv=None):
    arguments = _arguments(sys.argv[1:] if argv is None else argv)
    needs.require()
    from brisance.run import BadRun
    try:
        out = write(arguments.runs, arguments.out, not arguments.no_pdf)
    except BadRun as error:
        print(f"brisance report: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except OSError as error:
        print(f"brisance report: {error}", file=sys.stderr)
        return EXIT_RESOURCES
    print(out)
    return EXIT_OK


if __name__ == "__main__":
    sys.exit(main())
