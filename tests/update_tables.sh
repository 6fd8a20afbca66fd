#!/usr/bin/env bash
# Makes the committed tables of outcomes and errors anew, or with --widen lets them include what is
# found here: with every kernel of OpenBLAS that runs on this machine, on one and on two threads.
# Usage: tests/update_tables.sh [--widen]   after ./run test; then look at git diff tests/data
#        tests/update_tables.sh --fields    what follows from bench/records/record_fields.def:
#                                           tables of results/README.md, plots/record_fields.json
#        tests/update_tables.sh --published   tables and pictures of docs/validation.md, from results/validation
set -euo pipefail
cd -- "$(dirname "$(dirname "$(realpath -- "${BASH_SOURCE[0]}")")")"
if [[ ${1:-} == --fields ]]; then
  AIRYBENCH_UPDATE=anew build/release/tests/bench_test --gtest_brief=1 --gtest_filter='RecordFormat.*'
  exit
fi
if [[ ${1:-} == --published ]]; then
  exec /usr/bin/python3 plots/validation.py results/validation --page=docs/validation.md --out=docs/images
fi
update=anew
if [[ ${1:-} == --widen ]]; then update=widen; fi
kernels=(Prescott)
if grep -qw avx2 /proc/cpuinfo; then kernels+=(Haswell Zen); fi
if grep -qw avx512vl /proc/cpuinfo; then kernels+=(SkylakeX); fi
status=0
for kernel in "${kernels[@]}"; do
  for threads in 1 2; do
    echo "$kernel, $threads threads: $update"
    OPENBLAS_CORETYPE=$kernel OPENBLAS_NUM_THREADS=$threads AIRYBENCH_UPDATE=$update \
      build/release/tests/bench_test --gtest_brief=1 --gtest_filter='*StabilityOutcomes.*:*ErrorPoints.*' || status=1
    update=widen
  done
done
exit "$status"
