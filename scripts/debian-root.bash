# shellcheck shell=bash
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# Roots of their own for test-on and test-package, which read this file. Both have `say` and `fail`.

need_root_rights() { [ "$(id -u)" = 0 ] || fail "a root of its own needs root rights: call it as root, or with sudo"; }

# release_of NAME: the name in Debian's archive.
release_of() {
  case "$1" in
    debian12) echo bookworm ;;
    debian13) echo trixie ;;
    *) fail "which system: debian12 or debian13?" ;;
  esac
}

# make_root RELEASE FOLDER FRESH LOG: a bare Debian, unless it is there.
make_root() {
  local archive
  need_root_rights
  command -v debootstrap >/dev/null || fail "debootstrap is missing: apt-get install debootstrap"
  if [ "$3" = yes ]; then
    grep -q " $2/" /proc/mounts && fail "something is mounted in $2: unmount it first"
    rm -rf --one-file-system "$2"
  fi
  if [ ! -f "$2/.complete" ]; then
    # shellcheck disable=SC2016 # apt replaces them
    archive=$(apt-get indextargets --format '$(ORIGIN)|$(CODENAME)|$(REPO_URI)' 'Identifier: Packages' | sed -n 's/^Debian|[^|-]*|//p' | head -n 1)
    [ -n "$archive" ] || fail "apt knows no Debian archive on this machine: add it to the apt sources and run apt-get update"
    say "making a bare $1 in $2"
    mkdir -p "$2"
    debootstrap --variant=minbase --include=ca-certificates "$1" "$2" "$archive" >"$4" 2>&1 || fail "debootstrap failed ($(tail -n 1 "$4")); the log is $4"
    # The root is thrown away, not kept over a loss of power.
    echo force-unsafe-io >"$2/etc/dpkg/dpkg.cfg.d/unsafe-io"
    touch "$2/.complete"
  fi
  cp /etc/resolv.conf /etc/hosts "$2/etc/" 2>/dev/null || :
}

# in_root FOLDER COMMAND [CACHE]: runs COMMAND there by bash. Mounts and processes end with it. Only the words of mpirun's root rights and the number of
# jobs go in; with CACHE, compilers are called through the ccache of the root, which keeps its results in that folder.
in_root() {
  # shellcheck disable=SC2016 # the inner shell replaces them
  unshare --mount --pid --fork bash -c '
    mount --make-rprivate / && mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && mount -t sysfs sysfs "$1/sys" || exit 1
    if [ -n "$4" ]; then mkdir -p "$4" "$1/var/cache/ccache" && mount --bind "$4" "$1/var/cache/ccache" || exit 1; fi
    exec chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root TERM=dumb \
      OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ${3:+ECCENTRA_JOBS=$3 CMAKE_BUILD_PARALLEL_LEVEL=$3} \
      ${4:+CCACHE_DIR=/var/cache/ccache CCACHE_SLOPPINESS=pch_defines,time_macros CMAKE_CXX_COMPILER_LAUNCHER=ccache} bash -c "$2"' \
    - "$1" "$2" "${ECCENTRA_JOBS:-}" "${3:-}" </dev/null
}

# copy_tree FOLDER: the tracked files as they stand; what was built there stays. Only what differs is replaced, with the time of now: builds go by
# times, and a file may be older than what was built from its predecessor.
copy_tree() {
  local new file there
  mkdir -p "$1"
  new=$(mktemp -d -p "$(dirname "$1")") # beside it: on the same disk
  git ls-files -z | tar --null --ignore-failed-read -cf - -T - | tar -xf - -C "$new"
  mapfile -d '' -t there < <(cd "$1" && find . -mindepth 1 ! -path './build*' -print0) # all of it before any of it is gone
  for file in "${there[@]}"; do
    [ -e "$new/$file" ] || [ -L "$new/$file" ] || rm -rf "${1:?}/$file"
  done
  while IFS= read -r -d '' file; do
    if ! cmp -s "$new/$file" "$1/$file" || [ "$(stat -c %a "$new/$file")" != "$(stat -c %a "$1/$file")" ]; then
      mkdir -p "$(dirname "$1/$file")"
      rm -f "$1/$file"
      cp -P "$new/$file" "$1/$file"
    fi
  done < <(cd "$new" && find . ! -type d -print0)
  rm -rf "$new"
}
