# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the studies: the same rows as text, CSV and Markdown."""
import csv
import datetime
import math
import os
import platform


def number(value, digits=3):
    """A number as people write it; '-' for what is not known."""
    if isinstance(value, str) or value is None:
        return value or "-"
    if math.isnan(value):
        return "-"
    if value == 0:
        return "0"
    size = abs(value)
    if size >= 1e5 or size < 1e-3:
        return f"{value:.{digits - 1}e}"
    return f"{value:.{max(0, digits - 1 - math.floor(math.log10(size)))}f}"


def text(header, rows):
    """Columns as wide as they need to be, the first to the left."""
    cells = [header] + [[number(v) for v in row] for row in rows]
    width = [max(len(row[k]) for row in cells) for k in range(len(header))]
    return "\n".join("  ".join(c.ljust(w) if k == 0 else c.rjust(w) for k, (c, w) in enumerate(zip(row, width))).rstrip()
                     for row in cells) + "\n"


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(number(v) for v in row) + " |" for row in rows]) + "\n"


def write_csv(path, header, rows):
    with open(path, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(header)
        writer.writerows(rows)


def called(script, words):
    """The call as others can repeat it: without the folders and files of this machine."""
    kept, skip = [], False
    for word in words:
        if skip:
            skip = False
        elif word in ("--build", "--output", "--measured", "--jobs"):
            skip = True
        elif not word.startswith(("--build=", "--output=", "--measured=", "--jobs=")):
            kept.append(word)
    return " ".join([script, *kept])


def made(script, settings):
    """When, on what and with which settings something was measured."""
    model = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")),
                 platform.machine())
    load = os.getloadavg()[0]
    return (f"Made by `{script}` on {datetime.date.today().isoformat()}, {os.cpu_count()} cores ({model}), load {load:.1f} at the end; "
            f"{settings}.")
