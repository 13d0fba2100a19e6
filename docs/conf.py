# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The documentation as a site: scripts/docs builds it."""
import inspect
import pathlib
import re

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

project = "Eccentra"
author = "Eccentra contributors"
copyright = "Eccentra contributors, GPL-3.0-or-later"
release = re.search(r"project\(eccentra VERSION ([0-9.]+)", (pathlib.Path(__file__).parent.parent / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.graphviz"]
graphviz_output_format = "svg"
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence"]
myst_heading_anchors = 3
root_doc = "index"
exclude_patterns = ["README.md"]
html_theme = "furo"
html_title = f"Eccentra {release}"
html_math_renderer = "mathml"
# The pages of programs are their man pages, too.
man_pages = [(name, name, summary, "", 1) for name, summary in {
    "annulusFoam": "flow of a yield-stress fluid in an annulus, alone or with particles",
    "annulusMesh": "mesh of an inclined eccentric annulus",
    "annulusReport": "tables, charts and pictures of coupled cases",
    "clusterShape": "make, measure, compare and draw shapes of particles",
    "dragLaw": "drag coefficients of the drag laws of fix fluid/force",
    "eccentra": "new cases, runs, reports, studies, and a check of the installation",
    "eccentra-dem": "LIGGGHTS with the styles of Eccentra",
    "eccentra-keys": "keys of the two sides of a socket link",
    "eccentra-run": "run a coupled case, or continue its run",
}.items()]
html_static_path = ["_static"]
html_css_files = ["eccentra.css"]
html_show_sphinx = False
pygments_style = "friendly"
# Input scripts and dictionaries are highlighted as plain text.
highlight_language = "none"


# Formulas are MathML in the page, which needs neither a script nor a network. The converter of docutils aligns rows without `aligned`.
BLOCK = {"inline": False} if "inline" in inspect.signature(tex2mathml).parameters else {"as_block": True}  # docutils 0.20 and later


def block_of(formula):
    rows = re.sub(r"\\(begin|end){aligned}", "", formula)
    return f'<div class="formula">{tex2mathml(rows, **BLOCK)}</div>'


def show(render):
    def visit(writer, node):
        writer.body.append(render(node.astext()))
        raise nodes.SkipNode

    return visit, None


def setup(app):
    app.add_html_math_renderer("mathml", show(tex2mathml), show(block_of))
