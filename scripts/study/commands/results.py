# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts what the studies found into docs/results.md, with their charts: nothing on that page is written by hand. What has no
results there, a study or one of its parts, stays as it is on the page."""
import argparse
import pathlib
import re
import shutil

from .. import page_parts
from ..programs import ROOT

CENTRAL_CHART, COPY = "truth-cube.svg", "results-levels-cube.svg"  # of a study, and in docs, where the start page shows it
STUDIES = ("accuracy-cost", "paper", "full-scene")
HEAD = """# Results
Made by `scripts/results` from what [accuracy-cost](accuracy-cost.md), [paper](paper.md) and `scripts/full-scene` wrote; do not edit.
Each part says when, on how many cores and with which settings. `+-` is a standard error.
"""
MARK = "<!-- {} -->"  # before the part of a study


def parts_of(page):
    """{study: its part} of a page that stands."""
    places = sorted((page.find(mark := MARK.format(study)) + len(mark), study) for study in STUDIES if MARK.format(study) in page)
    ends = [place - len(MARK.format(study)) for place, study in places[1:]] + [len(page)]
    return {study: page[place:end].strip("\n") for (place, study), end in zip(places, ends)}


def main():
    parser = argparse.ArgumentParser(prog="results", description=__doc__, allow_abbrev=False)
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results", help="folder of the studies' results (default: results)")
    parser.add_argument("--docs", type=pathlib.Path, default=ROOT / "docs", help="folder of the page (default: docs)")
    words = parser.parse_args()
    target = words.docs / "results.md"
    standing = parts_of(target.read_text()) if target.is_file() else {}
    page, found = [HEAD], 0
    for study in STUDIES:
        page.append(MARK.format(study) + "\n")
        # The largest study that there is.
        folders = [words.results / f"{study}{size}" for size in ("-full", "", "-quick")]
        folder = next((f for f in folders if (f / "results.md").is_file()), None)
        if folder is None:
            page.append(standing.get(study, f"## {study}\n\nNot run yet: `scripts/{study} --quick`.") + "\n")
            continue
        found += 1
        text = (folder / "results.md").read_text()
        for whole, name in re.findall(r"(!\[[^\]]*\]\(([\w./-]+\.(?:svg|png))\))", text):
            if name == CENTRAL_CHART:
                shutil.copy(folder / name, words.docs / COPY)
                text = text.replace(f"]({name})", f"]({COPY})")
            else:  # pictures belong to the results of a run, not to the sources
                text = text.replace(whole, f"Chart: `results/{folder.name}/{name}`.")
        page.append(page_parts.renewed(study, standing.get(study, ""), text).strip("\n") + "\n")
    if not found:
        parser.error(f"there is no result in {words.results}: run scripts/accuracy-cost --quick first")
    target.write_text("\n".join(page))
    print(f"written: {target}")
    return 0
