# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the studies in scripts/ share: runs that are kept, statistics, charts, scenes."""
