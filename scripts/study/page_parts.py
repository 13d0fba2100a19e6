# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of several parts of which a call of a study makes one: the others stay."""
import re

MARK = "<!-- {}: {} -->"  # study, part: stands before the part
HEAD = "head"  # of the parts: words common to all


def parts_of(study, page):
    """{part: its text} of a page; what stands before the first mark is not in it."""
    pieces = re.split(MARK.format(re.escape(study), "(.+?)"), page)
    return {name: text.strip("\n") for name, text in zip(pieces[1::2], pieces[2::2])}


def page_of(study, parts):
    """Parts whose names begin with the same word stand together, in the order in which the words and the parts came."""
    words = list(dict.fromkeys(name.split()[0] for name in parts))
    ordered = sorted(parts, key=lambda name: words.index(name.split()[0]))
    return "\n\n".join(f"{MARK.format(study, name)}\n\n{parts[name]}" for name in ordered) + "\n"


def renewed(study, standing, page):
    """A page with the parts of another in place of its own, or beside them; the other one itself if it has no parts."""
    new = parts_of(study, page)
    return page_of(study, parts_of(study, standing) | new) if new else page
