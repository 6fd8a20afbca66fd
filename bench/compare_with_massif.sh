#!/usr/bin/env bash
# Holds the bench's own heap peak against valgrind's massif, on Mesh0.
#
#   compare_with_massif.sh BENCH [METHOD...]
#
# The bench runs twice: once as it is, counting for itself, and once under massif, which puts its own
# allocator in the place of ours. Compared is the highest heap of the whole process
# (process_peak_heap_bytes). `during` says how much of it was there during the memory run, blocks
# included: close to it, the process's peak is the solve's. Exit status 1 when the counts differ by
# more than 5 %.
set -euo pipefail
bench=$1
shift
methods=("$@")
((${#methods[@]})) || methods=(3STEPD 3STEPD:CHOLMOD HYBRID)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
arguments=(--mesh=Mesh0 --repetitions=1)
worst=0
printf '%-16s %12s %12s %12s %8s\n' method 'during (B)' 'bench (B)' 'massif (B)' ratio
for method in "${methods[@]}"; do
  "$bench" "${arguments[@]}" --method="$method" --out="$work/own" >/dev/null 2>&1
  own=$(sed -E 's/.*"process_peak_heap_bytes":([0-9]+).*/\1/' "$work/own/records.jsonl")
  during=$(sed -E 's/.*"peak_heap_bytes":([0-9]+),"peak_rss.*/\1/' "$work/own/records.jsonl")
  valgrind --tool=massif --soname-synonyms=somalloc=NONE --massif-out-file="$work/massif" \
    --peak-inaccuracy=0.0 "$bench" "${arguments[@]}" --method="$method" --out="$work/other" \
    >/dev/null 2>&1
  massif=$(sed -nE 's/^mem_heap_B=//p' "$work/massif" | sort -n | tail -n 1)
  printf '%-16s %12d %12d %12d %8s\n' "$method" "$during" "$own" "$massif" \
    "$(awk "BEGIN {printf \"%.4f\", $own / $massif}")"
  awk "BEGIN {exit !($own / $massif > 1.05 || $own / $massif < 0.95)}" && worst=1
done
((worst == 0)) || echo "compare_with_massif: the counts differ by more than 5 %" >&2
exit "$worst"
