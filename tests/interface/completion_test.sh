#!/usr/bin/env bash
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# Completes command lines as a shell does: completion_test.sh COMPLETION BIN
set -uo pipefail
# shellcheck source=/dev/null
. "$1"
PATH=$2:$PATH
failed=0

# expect WORD... = REPLY...: the completion of a line whose last word is the one at the cursor.
expect() {
  local reply
  COMP_WORDS=()
  while [ "$1" != = ]; do COMP_WORDS+=("$1"); shift; done
  shift
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _eccentra "${COMP_WORDS[0]}"
  reply=${COMPREPLY[*]}
  [ "$reply" = "$*" ] || { printf '%s\n' "'${COMP_WORDS[*]}' is completed by '$reply'; expected '$*'"; failed=1; }
}

expect clusterShape --part = --partner
expect clusterShape --partner s = sphere surface
expect clusterShape cub = cube
expect clusterShape sm = smooth
expect clusterShape h = hull
expect clusterShape disk "" = 7 19 48
expect clusterShape compare cube 6 = 64
expect clusterShape compare cube "" = 8 27 64
expect clusterShape stl "" =
expect eccentra-dem -res = -resume
expect eccentra-run case --void-fraction d = divided diffusion
expect eccentra-run case --resu = --resume
expect eccentra "do" = doctor
expect eccentra new w = well
expect eccentra new --incl = --inclination
expect annulusReport --no = --no-pictures
expect annulusReport --nothing-of-this-name =
for program in annulusFoam:-case annulusMesh:-dict dragLaw:--reynolds; do
  command -v "${program%:*}" >/dev/null || continue
  expect "${program%:*}" "${program#*:}" = "${program#*:}"
done
exit $failed
