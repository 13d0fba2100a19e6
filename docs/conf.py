# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The documentation as a site: scripts/docs builds it."""
import pathlib
import re

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
html_extra_path = []
pygments_style = "friendly"
# Input scripts and dictionaries are highlighted as plain text.
highlight_language = "none"
