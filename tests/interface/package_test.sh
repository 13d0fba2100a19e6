#!/usr/bin/env bash
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# package_test.sh SOURCE BUILD: makes the Debian packages; lintian finds no error, and the package does what it promises. 77: not possible here.
set -euo pipefail
source=$1 build=$2
[ "$(id -u)" = 0 ] || { echo "needs root rights"; exit 77; }
grep -qw overlay /proc/filesystems || { echo "needs the overlay file system"; exit 77; }
folder=$build/tests/run/interface_package
rm -rf "$folder"
mkdir -p "$folder"
(cd "$build" && cpack -B "$folder") >"$folder/cpack.log" 2>&1 || { cat "$folder/cpack.log"; exit 1; }
if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error "$folder"/*.deb
else
  echo "lintian is not installed: its check is left out"
fi
"$source/scripts/test-package" "$(echo "$folder"/eccentra_*.deb)"
