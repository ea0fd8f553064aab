# shellcheck shell=bash
# SPDX-FileCopyrightText: The stairwayd authors
# SPDX-License-Identifier: Apache-2.0
# Steps that the scripts share; to be sourced.
set -euo pipefail

root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
logs=$root/build/logs

fail() {
  echo "${0##*/}: $*" >&2
  exit 1
}

# Compilers of Eigen code take about 1 GB each.
parallel_jobs() {
  local by_memory
  by_memory=$(awk '/^MemAvailable/ {print int($2 / 1000000)}' /proc/meminfo)
  echo $((by_memory < 1 ? 1 : by_memory < $(nproc) ? by_memory : $(nproc)))
}

# run_quietly NOTE NAME COMMAND...: says NOTE, keeps what the command says in a log, and shows it all on failure. A
# terminal sees the last line while it runs.
run_quietly() {
  local note=$1 log=$logs/$2.log start=$SECONDS status=0 command
  shift 2
  mkdir -p "$logs"
  printf '%s ...' "$note" >&2
  "$@" >"$log" 2>&1 </dev/null &
  command=$!
  if [[ -t 2 ]]; then
    while kill -0 "$command" 2>/dev/null; do
      printf '\r\e[K%s ... %.60s' "$note" "$(tail -n 1 "$log" | tr -d '\r\e')" >&2
      sleep 0.5
    done
    printf '\r\e[K%s ...' "$note" >&2
  fi
  wait "$command" || status=$?
  if ((status != 0)); then
    echo " failed" >&2
    cat "$log" >&2
    fail "$note: failed with exit code $status; the log is $log"
  fi
  echo " done in $((SECONDS - start)) s" >&2
}

# build PRESET [CMAKE OPTION...] [-- TARGET...]: configures and builds.
build() {
  local preset=$1 options=()
  shift
  while (($# > 0)) && [[ $1 != -- ]]; do
    options+=("$1")
    shift
  done
  shift $(($# > 0 ? 1 : 0))
  cd "$root"
  run_quietly "Configuring ($preset)" "configure-$preset" cmake --preset "$preset" "${options[@]}"
  run_quietly "Building ($preset; minutes when it is the first time)" "build-$preset" \
    cmake --build --preset "$preset" --parallel "$(parallel_jobs)" ${1:+--target "$@"}
}

# run_tests PRESET [CTEST OPTION...]: runs tests that are built, and sums up.
run_tests() {
  local preset=$1
  shift
  cd "$root"
  run_quietly "Testing ($preset)" "test-$preset" ctest --preset "$preset" --parallel "$(nproc)" "$@"
  if grep -q 'No tests were found' "$logs/test-$preset.log"; then
    fail "no test fits '$*'; 'ctest --preset $preset -N' lists them all"
  fi
  grep -E '^[0-9]+% tests passed|^Total Test time|\(Skipped\)|Not Run' "$logs/test-$preset.log"
}
