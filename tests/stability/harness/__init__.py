# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Harness of scripts/hard-cases: reads case files, runs them, judges what was measured, writes the page."""
