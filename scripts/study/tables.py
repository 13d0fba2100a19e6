# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the studies: the same rows as text, CSV and Markdown."""
import csv
import datetime
import math
import os
import pathlib
import platform
import sys

from . import page_parts


def number(value, digits=3):
    """A number as people write it; '-' for what is not known."""
    if isinstance(value, str) or value is None:
        return "-" if value is None else value
    if isinstance(value, int):
        return str(value)
    if math.isnan(value):
        return "-"
    if value == 0:
        return "0"
    size = abs(value)
    if size >= 1e5 or size < 1e-3:
        return f"{value:.{digits - 1}e}"
    return f"{value:.{max(0, digits - 1 - math.floor(math.log10(size)))}f}"


def text(header, rows, digits=3):
    """Columns as wide as they need to be, the first to the left."""
    cells = [header] + [[number(v, digits) for v in row] for row in rows]
    width = [max(len(row[k]) for row in cells) for k in range(len(header))]
    return "\n".join("  ".join(c.ljust(w) if k == 0 else c.rjust(w) for k, (c, w) in enumerate(zip(row, width))).rstrip()
                     for row in cells) + "\n"


def markdown(header, rows, digits=3):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(number(v, digits) for v in row) + " |" for row in rows]) + "\n"


def write_csv(path, header, rows):
    with open(path, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(header)
        writer.writerows(rows)


OF_THIS_MACHINE = ("--build", "--out", "--output", "--measured", "--data", "--jobs")


def called(script, words):
    """The call as others can repeat it: without the folders and files of this machine."""
    kept, skip = [], False
    for word in words:
        if not skip and word not in OF_THIS_MACHINE and not word.startswith(tuple(f"{name}=" for name in OF_THIS_MACHINE)):
            kept.append(word if " " not in word else f'"{word}"')
        skip = word in OF_THIS_MACHINE
    return " ".join([script, *kept])


def made(script, settings):
    """When, on what and with which settings something was measured."""
    model = next((line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")),
                 platform.machine())
    load = os.getloadavg()[0]
    return (f"Made by `{called(script, sys.argv[1:])}` on {datetime.date.today().isoformat()}, {os.cpu_count()} cores ({model}), "
            f"load {load:.1f} at the end; {settings}.")


def finish(chosen, page, failed, *settings):
    """Writes results.md with how it was made, says what is there and what failed; the exit status. chosen: the options. page: lines, or
    {part: lines} of the parts that this call makes of a page whose other parts stay; the part HEAD, common to them, was not made by one call."""
    study, target = pathlib.Path(sys.argv[0]).name, chosen.out / "results.md"
    said = made(f"scripts/{study}", "; ".join([*settings[:1], chosen.store.account(), *settings[1:]]))
    ended = lambda lines: "\n".join(lines) + f"\n*{said}*\n"
    if isinstance(page, dict):
        standing = target.read_text() if target.is_file() else ""
        texts = {part: ("\n".join(lines) if part == page_parts.HEAD else ended(lines)).strip("\n") for part, lines in page.items()}
        target.write_text(page_parts.renewed(study, standing, page_parts.page_of(study, texts)))
    else:
        target.write_text(ended(page))
    print(f"written to {chosen.out}: {', '.join(sorted(file.name for file in chosen.out.iterdir() if file.is_file()))}")
    for sentence in sorted(set(failed)):
        print(f"FAILED {sentence}")
    return 1 if failed else 0


def publish(chosen, name, title, header, rows, digits=3):
    """A table as CSV and on the screen; its Markdown for the page."""
    write_csv(chosen.out / f"{name}.csv", header, rows)
    print(f"{title}\n\n{text(header, rows, digits)}")
    return f"{title}\n\n{markdown(header, rows, digits)}"
