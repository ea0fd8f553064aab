# shellcheck shell=bash
# SPDX-FileCopyrightText: The stairwayd authors
# SPDX-License-Identifier: Apache-2.0
# What the scripts of the virtual bench share; to be sourced.
set -euo pipefail

bench=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
PATH=$PATH:/usr/sbin:/sbin
readonly cannot_run=77

# cannot REASON: the bench cannot run here, which is nobody's failure.
cannot() {
  echo "virtual bench: cannot run: $*" >&2
  exit $cannot_run
}

# kernel_release: of the newest installed headers; their source package has the same version.
kernel_release() {
  local headers
  headers=$(find /usr/src -maxdepth 1 -name 'linux-headers-*-amd64' -printf '%f\n' | sort -V | tail -n 1)
  [[ -n $headers ]] || cannot "no kernel headers; install linux-headers-amd64"
  echo "${headers#linux-headers-}"
}

# kernel_folder: where make-kernel puts the kernel that these scripts want.
kernel_folder() {
  local release version cache
  release=$(kernel_release)
  version=$(dpkg-query -W -f '${Version}' "linux-headers-$release")
  cache=${STAIRWAY_BENCH_CACHE:-${XDG_CACHE_HOME:-${HOME:-/var/tmp}/.cache}/stairwayd/virtual-bench}
  echo "$cache/$version-$(cat "$bench/make-kernel" "$bench/guest-init" | sha256sum | cut -c 1-12)"
}
