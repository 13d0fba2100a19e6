#!/usr/bin/env bash
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# A program that starts eccentra-run in another folder may leave its own in PWD; a shell would mend it. foreign_pwd_test.sh CASE FOLDER
set -euo pipefail
rm -rf "$2"
mkdir -p "$(dirname "$2")"
env PWD=/usr /usr/bin/python3 "$ECCENTRA_BIN/eccentra-run" "$1" --seconds 0.01 --count 5 --run-in 1 --output "$2" > "$2.log" 2>&1 || { tail -n 5 "$2.log"; exit 1; }
