#!/usr/bin/env bash
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# The case fluidised-bed, a little faster: its onset of fluidisation against Ergun's equation. fluidised_bed_test.sh CASE FOLDER
set -euo pipefail
rm -rf "$2"
mkdir -p "$(dirname "$2")"
"$1/run" --output "$2" --seconds 0.8 > "$2.log" 2>&1 || { tail -5 "$2.log"; exit 1; }
"$1/onset" "$2" --within 10
