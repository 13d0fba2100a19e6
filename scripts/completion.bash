# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of the command lines of Eccentra's programs in bash: options from their own --help, shapes from `clusterShape list`.
# A package installs it; otherwise: . scripts/completion.bash

declare -gA _eccentra_options

# Options that the help of the program $1 names; asked for once in a shell.
_eccentra_options_of() {
  local help=--help
  [ "${1##*/}" != eccentra ] || [[ "${COMP_WORDS[1]:-}" != [a-z]* ]] || help="${COMP_WORDS[1]} --help"
  case ${1##*/} in annulusFoam | annulusMesh) help=-help ;; esac
  local key="$1 $help"
  if [ -z "${_eccentra_options[$key]+known}" ]; then
    # shellcheck disable=SC2086 # the help of a command of eccentra is two words
    _eccentra_options[$key]=$("$1" $help 2>/dev/null </dev/null | grep -oE '(^|[][ (,|])--?[A-Za-z][A-Za-z0-9_-]*' | grep -oE -- '-.*' | sort -u)
    case ${1##*/} in
      eccentra-dem) _eccentra_options[$key]+=' -var -log -screen -echo -partition' ;;
      eccentra-run) _eccentra_options[$key]+=' --seconds --count --inclination --rpm --length --seed' ;;
    esac
  fi
  printf '%s' "${_eccentra_options[$key]}"
}

# Words that may follow $2 in a command of the program $1; nothing where a file is expected.
_eccentra_words() {
  case $2 in
    --partner) printf '%s' 'plane sphere surface cluster' ;;
    --estimate) printf '%s' 'min mean max paper' ;;
    --mass) printf '%s' 'union solid' ;;
    --cover) printf '%s' 'inside balanced' ;;
    --link) printf '%s' 'solver socket' ;;
    --overlap) printf '%s' 'yes no' ;;
    --momentum) printf '%s' 'semiImplicit explicit' ;;
    --void-fraction) printf '%s' 'centre divided gaussian diffusion' ;;
    clusterShape | compare) "$1" --help 2>/dev/null | sed -n 's/^  clusterShape \([a-z]*\) .*/\1/p' | sort -u ;;
    advise) printf '%s' 'cube disk' ;;
    eccentra) "$1" --help 2>/dev/null | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p' | grep -v '^eccentra$' ;;
    new) printf '%s' 'section well bed heap drum' ;;
    -*) ;;
    *) [ "${1##*/}" != clusterShape ] || "$1" list 2>/dev/null | awk -v family="$2" '$1 == family { print $2 }' ;;
  esac
}

_eccentra() {
  local program=$1 word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words
  COMPREPLY=()
  if [[ $word == -* ]]; then
    words=$(_eccentra_options_of "$program")
  else
    words=$(_eccentra_words "$program" "${before##*/}")
  fi
  [ -z "$words" ] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}

complete -o default -F _eccentra annulusFoam annulusMesh annulusReport clusterShape dragLaw eccentra eccentra-dem eccentra-keys eccentra-run
