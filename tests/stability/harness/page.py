# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results: one table per group, as Markdown, with the chart of the map."""
from . import map_chart


def _cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def write(folder, groups, results):
    lines = ["# Hard cases: what was measured", "",
             "Cases whose name ends in `/fails` (or `/fails_WORD`) run in a configuration that is known to fail: for them, pass means that "
             "the criterion was broken, as it must be.", ""]
    for group in groups:
        there = [results[case.id] for case in group.cases if case.id in results]
        if not there:
            continue
        good = sum(result["verdict"] == "pass" for result in there)
        lines += [f"## {group.title}", "", group.theory, "", f"{good} of {len(there)} as they must be.", ""]
        rows = [row for result in there for row in result.get("points", [])]
        if rows:
            name = f"hard-cases-{group.name}.svg"
            map_chart.write(folder / name, rows)
            lines += [f"![{group.title}]({name})", ""]
        lines += ["| case | what | criterion | measured | verdict | s |", "|---|---|---|---|---|---|"]
        lines += ["| " + " | ".join(_cell(result[key]) for key in ("id", "what", "criterion", "measured", "verdict",
                                                                 "seconds")) + " |" for result in there]
        lines.append("")
    (folder / "report.md").write_text("\n".join(lines))
