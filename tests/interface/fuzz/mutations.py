# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What makes a sentence of a grammar wrong: words that are dropped, doubled, exchanged, replaced or cut."""
import re

from hypothesis import strategies as st

NUMBERS = ["nan", "-nan", "inf", "-inf", "1e400", "-1e-400", "0", "-0", "-1", "00", "1e", "e5", "5e-3.2", "1,5", "0x1p3", "1e308", "4294967296",
           "9223372036854775808", "-2147483649", "1.0000000000000000000000001", "6.35mm", "+-3", ".", "..", "1e-310", "99999999999999999999"]
MARKS = ["", "&", "$", "${no}", "v_no", "*", "#", '"', "'", "{", "}", "(", ")", ";", ",", "/*", "//", "\\", "%s%n", "\t", "\n", "\r", "\0", "é", "\udcff",
         "$include", "#include \"x\"", "#calc \"1\"", "../" * 8, "a" * 300, "1" * 400]


@st.composite
def mutated(draw, sentences, words=(), most=3):
    """A sentence of `sentences`, with up to `most` changes; `words`: of the language, to put where they do not belong."""
    pieces = re.split(r"(\s+|[;(){},\"])", draw(sentences))
    for _ in range(draw(st.integers(0, most))):
        at = draw(st.integers(0, len(pieces) - 1))
        change = draw(st.sampled_from(["drop", "double", "exchange", "number", "mark", "word", "cut", "splice"]))
        if change == "drop":
            pieces[at] = ""
        elif change == "double":
            pieces[at] = f"{pieces[at]} {pieces[at]}"
        elif change == "exchange":
            other = draw(st.integers(0, len(pieces) - 1))
            pieces[at], pieces[other] = pieces[other], pieces[at]
        elif change == "number":
            pieces[at] = draw(st.sampled_from(NUMBERS))
        elif change == "mark":
            pieces[at] += draw(st.sampled_from(MARKS))
        elif change == "word" and words:
            pieces[at] = draw(st.sampled_from(list(words)))
        elif change == "cut":
            pieces = pieces[: at + 1]
        elif change == "splice":
            place = draw(st.integers(0, len(pieces[at])))
            pieces[at] = pieces[at][:place] + draw(st.text(max_size=3)) + pieces[at][place:]
    return "".join(pieces)
