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
  if [[ ! -e $tree/tests/fuzz/fuzz_$reader ]]; then # HDF5 is optional
    echo "run: fuzz: $reader is not built" >&2
    continue
  fi
  corpus=$inputs/$reader
  new=$tree/corpus/$reader # inputs that reach more; they are not kept in git
  mkdir -p "$new"
  echo "run: fuzz: $reader, $seconds s" >&2
  "$tree/tests/fuzz/fuzz_$reader" -max_total_time="$seconds" -max_len=4096 -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$corpus/" "$new" "$corpus" || status=1
done
exit "$status"
