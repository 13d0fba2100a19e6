# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts/effects does beyond the sheared suspension: scenes, the annulus, and what an effect costs that is off."""
