#!/usr/bin/env bash
# Feeds the readers of files with random bytes. What breaks one stays in tests/data/fuzz.
#
#   fuzz.sh TREE [READER]... [--seconds=300]
#
# TREE is where the fuzzers are built.
set -euo pipefail
tree=$1
shift
inputs=$(dirname "$(dirname "$(realpath -- "${BASH_SOURCE[0]}")")")/data/fuzz
all=(mesh scene record night siconos fclib deck model)
readers=()
seconds=300
for argument in "$@"; do
  if [[ $argument == --seconds=[1-9]* ]]; then
    seconds=${argument#*=}
  elif [[ " ${all[*]} " == *" $argument "* ]]; then
    readers+=("$argument")
  else
    valid=$(printf '%s, ' "${all[@]}")
    echo "run: fuzz: unknown '$argument' (valid: ${valid}--seconds=N)" >&2
    exit 2
  fi
done
((${#readers[@]})) || readers=("${all[@]}")
status=0
for reader in "${readers[@]}"; do
  fuzzer=$tree/tests/fuzz/fuzz_$reader
  if [[ ! -e $fuzzer ]]; then # HDF5 is optional
    echo "run: fuzz: $reader is not built" >&2
    continue
  fi
  corpus=$inputs/$reader
  new=$tree/corpus/$reader # inputs that reach more; they are not kept in git
  mkdir -p "$new"
  # Of a longer file the rest would be cut off.
  longest=$(stat -c %s -- "$corpus"/good-* | sort -n | tail -1)
  options=(-max_total_time="$seconds" -max_len=$((longest > 4096 ? longest : 4096)) -timeout=10 -rss_limit_mb=2048)
  echo "run: fuzz: $reader, $seconds s" >&2
  if [[ $reader != fclib ]]; then
    "$fuzzer" "${options[@]}" -print_final_stats=1 -artifact_prefix="$corpus/" "$new" "$corpus" || status=1
    continue
  fi
  # libhdf5 crashes on damaged files every other minute, for which our reader has a child process.
  broken=$tree/broken/$reader
  rm -rf "$broken"
  mkdir -p "$broken"
  "$fuzzer" "${options[@]}" -fork=1 -ignore_crashes=1 -ignore_ooms=1 -ignore_timeouts=1 \
    -artifact_prefix="$broken/" "$new" "$corpus" || status=1
  for file in "$broken"/*; do
    [[ -e $file ]] || continue
    report=$("$fuzzer" -timeout=10 -rss_limit_mb=2048 "$file" 2>&1) && continue
    # Whose: the innermost of both in the trace, or in that of the memory's allocation.
    [[ ${report##*allocated by} =~ libhdf5|airybench:: && ${BASH_REMATCH[0]} == libhdf5 ]] && continue
    mv "$file" "$corpus/"
    echo "$report" >&2
    status=1
  done
done
exit "$status"
