# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drag coefficients written out from the printed formulas, for tests: (sphericity, Re, crosswise sphericity) -> C_D."""
import math


def chien(phi, re, _):
    return 30 / re + 67.289 * math.exp(-5.03 * phi)


def schiller_naumann(_, re, __):
    return 0.44 if re > 1000 else 24 / re * (1 + 0.15 * re ** 0.687)


def haider_levenspiel(phi, re, _):
    a = math.exp(2.3288 - 6.4581 * phi + 2.4486 * phi ** 2)
    b = 0.0964 + 0.5565 * phi
    c = math.exp(4.905 - 13.8944 * phi + 18.4222 * phi ** 2 - 10.2599 * phi ** 3)
    d = math.exp(1.4681 + 12.2584 * phi - 20.7322 * phi ** 2 + 15.8855 * phi ** 3)
    return 24 / re * (1 + a * re ** b) + c / (1 + d / re)


def ganser(phi, re, _):
    k1 = 1 / (1 / 3 + 2 / 3 / math.sqrt(phi))
    k2 = 10 ** (1.8148 * (-math.log10(phi)) ** 0.5743)
    r = re * k1 * k2
    return k2 * (24 / r * (1 + 0.1118 * r ** 0.6567) + 0.4305 / (1 + 3305 / r))


def holzer_sommerfeld(phi, re, across):
    return (8 / re / math.sqrt(across) + 16 / re / math.sqrt(phi) + 3 / math.sqrt(re) / phi ** 0.75
            + 0.42 * 10 ** (0.4 * (-math.log10(phi)) ** 0.2) / across)


def di_felice(_, re, __):
    return (0.63 + 4.8 / math.sqrt(re)) ** 2


LAWS = {law.__name__: law for law in (chien, haider_levenspiel, ganser, holzer_sommerfeld, schiller_naumann, di_felice)}
