# SPDX-License-Identifier: Apache-2.0
"""The report as one HTML page that needs nothing else: style, text and pictures inside."""

import base64
from html import escape

from brisance import discrepancies, facts, figures, measurements
from brisance.run import labels

CSS = """
:root { --ink: #222; --faint: #6b6b68; --line: #e2e1dc; --paper: #fff; --tint: #f7f6f2; --accent: #23527c; }
* { box-sizing: border-box; }
html { scroll-behavior: smooth; -webkit-text-size-adjust: 100%; }
body { margin: 0; color: var(--ink); background: var(--paper); font: 16px/1.55 "Source Sans 3", "Segoe UI", system-ui, -apple-system,
  "Helvetica Neue", Arial, sans-serif; }
main, header, nav ul, footer { max-width: 62rem; margin: 0 auto; padding: 0 1.1rem; }
header { padding-top: 2.4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem; font-weight: 650; letter-spacing: -.01em; }
h2 { font-size: 1.3rem; margin: 2.8rem 0 .7rem; padding-top: .7rem; border-top: 1px solid var(--line); font-weight: 650; }
h3 { font-size: 1rem; margin: 1.6rem 0 .4rem; }
p { max-width: 46rem; } .by, .note { color: var(--faint); } .note { font-size: .92rem; }
.lead { font-size: 1.06rem; }
nav { border-top: 1px solid var(--line); border-bottom: 1px solid var(--line); margin-top: 1.4rem; background: var(--tint); }
nav ul { display: flex; flex-wrap: wrap; gap: .15rem 1.1rem; list-style: none; padding-top: .55rem; padding-bottom: .55rem; font-size: .9rem; }
a { color: var(--accent); text-decoration: none; } a:hover { text-decoration: underline; }
figure { margin: 1.3rem 0 1.8rem; } figure img { max-width: 100%; height: auto; display: block; }
figcaption { font-size: .88rem; color: var(--faint); max-width: 46rem; margin-top: .45rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(19rem, 1fr)); gap: 0 1.5rem; }
.scroll { overflow-x: auto; margin: .8rem 0 1.4rem; }
table { border-collapse: collapse; font-size: .87rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: .32rem .9rem .32rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; white-space: nowrap; } thead th { border-bottom: 1.5px solid var(--ink); }
pre { background: var(--tint); border: 1px solid var(--line); border-radius: 4px; padding: .7rem .9rem; overflow-x: auto; font-size: .85rem; }
code { font-family: ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; }
details summary { cursor: pointer; color: var(--accent); }
footer { color: var(--faint); font-size: .85rem; padding-top: 2rem; padding-bottom: 3rem; }
@media (max-width: 40rem) { body { font-size: 15px; } h1 { font-size: 1.5rem; }
  .cards thead { display: none; } .cards tr { display: block; padding: .5rem 0; border-bottom: 1px solid var(--line); }
  .cards td, .cards th { display: block; border: 0; padding: .08rem 0; white-space: normal; }
  .cards td::before { content: attr(data-head) ": "; color: var(--faint); } }
@media print { nav { display: none; } figure { break-inside: avoid; } }
"""


def table(head, rows, kind=""):
    """An HTML table; the first cell of each row is its heading. kind "cards": rows turn into cards on a narrow screen."""
    top = "".join(f'<th scope="col">{escape(h)}</th>' for h in head)
    body = []
    for row in rows:
        cells = [f'<th scope="row">{escape(row[0])}</th>']
        cells += [f'<td data-head="{escape(h)}">{escape(c)}</td>' for h, c in zip(head[1:], row[1:])]
        body.append("<tr>" + "".join(cells) + "</tr>")
    return f'<div class="scroll"><table class="{kind}"><thead><tr>{top}</tr></thead><tbody>{"".join(body)}</tbody></table></div>'


def picture(saved):
    data = base64.b64encode(saved.png).decode("ascii")
    width, _ = (int.from_bytes(saved.png[k:k + 4], "big") for k in (16, 20))  # of the PNG's header
    style = f' style="width:{width / figures.PNG_DPI * 1.22:.1f}in"'  # figures are drawn for paper; a little larger on screen
    return (f'<figure id="fig-{escape(saved.key)}"><img{style} alt="{escape(saved.caption)}" src="data:image/png;base64,{data}">'
            f"<figcaption>{escape(saved.caption)}</figcaption></figure>")


def section(anchor, heading, *blocks):
    return f'<section id="{anchor}"><h2>{escape(heading)}</h2>{"".join(b for b in blocks if b)}</section>'


def paragraph(text, kind=""):
    return f'<p class="{kind}">{escape(text)}</p>' if text else ""


def _drawn(runs, anchor, heading, drawn):
    saved, reasons = drawn[anchor]
    pictures = [picture(s) for s in saved]
    if anchor == "borehole" and len(pictures) == 2:
        pictures = [f'<div class="pair">{"".join(pictures)}</div>']
    extra = ""
    if anchor == "damage" and any(r.sections for r in runs):
        extra = "<h3>Measures at the end of the run</h3>" + table(*facts.section_table(runs))
    if anchor == "gauges" and any(r.gauges for r in runs):
        extra = "<h3>Peak values</h3>" + table(*facts.peak_table(runs))
        shown = len([s for s in saved if s.key.startswith("gauge_")])
        if len(runs) == 1 and shown < len(runs[0].gauges):
            reasons = reasons + [f"{shown} of {len(runs[0].gauges)} gauges are drawn, spread over the distances; the table holds all."]
    if anchor in ("zones", "attenuation") and saved and not measurements.read():
        extra += paragraph("No measurements available: the files cases/validation/banadaki_mohanty/measured_*.csv hold no rows. "
                           "Rows entered there are drawn here.", "note")
    return section(anchor, heading, *pictures, *(paragraph(r, "note") for r in reasons), extra)


def page(runs, drawn):
    """The whole page as text. drawn: what figures.draw() handed back."""
    single, names = len(runs) == 1, labels(runs)
    title = runs[0].title if single else "Comparison: " + " · ".join(names)
    parts = [("summary", "Summary", None)]
    if not single:
        parts.append(("differences", "Differences", None))
    parts += [(anchor, heading, drawn) for anchor, heading, _ in figures.CATALOGUE]
    parts += [("facts", "Facts of the run" if single else "Facts of the runs", None),
              ("discrepancies", discrepancies.load()["title"], None),
              ("cite", "How to cite", None), ("repeat", "Commands to repeat", None)]
    blocks = {
        "summary": _summary(runs, names),
        "differences": _differences(runs),
        "facts": section("facts", dict((a, h) for a, h, _ in parts)["facts"], table(*facts.run_table(runs))),
        "discrepancies": section("discrepancies", discrepancies.load()["title"], paragraph(discrepancies.load()["intro"]),
                                 table(discrepancies.HEAD, discrepancies.rows(), "cards")),
        "cite": section("cite", "How to cite", *(f"<p><b>{escape(a)}.</b> {escape(b)}</p>" for a, b in facts.citation(runs))),
        "repeat": section("repeat", "Commands to repeat", f"<pre><code>{escape(chr(10).join(facts.commands(runs)))}</code></pre>",
                          paragraph("The resolved case of each run is case.toml in its directory: every material, with all "
                                    "includes, presets and settings merged.", "note")),
    }
    body = [blocks.get(a) or _drawn(runs, a, h, drawn) for a, h, _ in parts]
    links = "".join(f'<li><a href="#{a}">{escape(h)}</a></li>' for a, h, _ in parts)
    started = runs[0].provenance.get("started") if single else None
    by = f"brisance {runs[0].provenance.get('version', '')} · commit {facts.short_commit(runs[0])}" + (f" · {started}" if started else "")
    return ("<!DOCTYPE html>\n<html lang=\"en-GB\"><head><meta charset=\"utf-8\">"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
            f"<title>{escape(title)}</title><style>{CSS}</style></head><body>"
            f"<header><h1>{escape(title)}</h1><p class=\"by\">{escape(by)}</p></header>"
            f"<nav aria-label=\"Sections\"><ul>{links}</ul></nav><main>{''.join(body)}</main>"
            "<footer>Stresses are positive in tension, pressure in compression. The figures lie next to this page in figures/, "
            "as PNG and PDF.</footer></body></html>\n")


def _summary(runs, names):
    if len(runs) == 1:
        return section("summary", "Summary", paragraph(facts.summary(runs[0]), "lead"))
    return section("summary", "Summary", *(f"<p><b>{escape(n)}.</b> {escape(facts.summary(r))}</p>" for n, r in zip(names, runs)))


def _differences(runs):
    if len(runs) == 1:
        return ""
    ratios = facts.ratio_table(runs)
    return section(
        "differences", "Differences",
        "<h3>At 23 µs, in the lowest section</h3>",
        table(*ratios) if ratios else paragraph("No run has a record within 5 µs of 23 µs.", "note"),
        paragraph("The paper quotes the normalised probability at 23 µs as air : no copper : water = 1 : 1.79 : 3.78. "
                  "Ratios are taken over the air-coupled run where there is one, else over the first.", "note"),
        "<h3>At the end</h3>", table(*facts.difference_table(runs)),
        paragraph("In brackets: difference from the first run.", "note"))
