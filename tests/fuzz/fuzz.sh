#!/usr/bin/env bash
# Feeds the readers of files with random bytes. What breaks one stays in tests/data/fuzz.
#
#   fuzz.sh TREE [mesh | scene | record | night]... [--seconds=300]
#
# TREE is where the fuzzers are built.
set -euo pipefail
tree=$1
shift
inputs=$(dirname "$(dirname "$(realpath -- "${BASH_SOURCE[0]}")")")/data/fuzz
readers=()
seconds=300
for argument in "$@"; do
  case $argument in
    mesh | scene | record | night) readers+=("$argument") ;;
    --seconds=[1-9]*) seconds=${argument#*=} ;;
    *)
      echo "run: fuzz: unknown '$argument' (valid: mesh, scene, record, night, --seconds=N)" >&2
      exit 2
      ;;
  esac
done
((${#readers[@]})) || readers=(mesh scene record night)
status=0
for reader in "${readers[@]}"; do
  corpus=$inputs/$reader
  new=$tree/corpus/$reader # inputs that reach more; they are not kept in git
  mkdir -p "$new"
  echo "run: fuzz: $reader, $seconds s" >&2
  "$tree/tests/fuzz/fuzz_$reader" -max_total_time="$seconds" -max_len=4096 -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$corpus/" "$new" "$corpus" || status=1
done
exit "$status"
