#!/usr/bin/env bash
# Runs two revisions of this tree, or two programs, in turn, and compares them case by case.
#
#   compare_revisions.sh TREES A B [--runs=6] [--out=DIR] [options of bench]
#
# In TREES, the folder of build trees, are the bench that compares, clones and runs. Runs in turn feel the same drift of the machine.
set -euo pipefail
project=$(dirname "$(dirname "$(realpath -- "${BASH_SOURCE[0]}")")")
trees=$1
shift
unset AIRYBENCH_BUILD_DIR # a clone builds in itself

# program_of A: the file, or bench of a revision, which is built in a clone.
program_of() {
  local revision said source
  if [[ -f $1 && -x $1 ]]; then
    realpath -- "$1"
    return
  fi
  if [[ -n $(git -C "$project" rev-parse --show-prefix 2>/dev/null) ]]; then
    echo "run: compare: $1 (allowed: a program): $project is no repository" >&2
    exit 2
  fi
  if ! revision=$(git -C "$project" rev-parse --quiet --verify "$1^{commit}" 2>&1); then
    echo "run: compare: $1 (allowed: a git revision, or a program)${revision:+: ${revision%%$'\n'*}}" >&2
    exit 2
  fi
  source=$trees/compare/$revision
  if [[ ! -e $source/CMakeLists.txt ]]; then
    if ! said=$({ rm -rf "$source" && git clone --quiet --no-checkout "$project" "$source" &&
      git -C "$source" checkout --quiet "$revision"; } 2>&1); then
      echo "run: compare: $1 cannot be cloned to $source: ${said%%$'\n'*}" >&2
      exit 2
    fi
  fi
  if ! AIRYBENCH_FIGURES=no "$source/run" bench --help >/dev/null; then
    echo "run: compare: $1 cannot be built" >&2
    exit 2
  fi
  echo "$source/build/release/bench/bench"
}

sides=()
runs=6
out=$trees/compare/runs
options=()
for argument in "$@"; do
  case $argument in
    --runs=[1-9]*) runs=${argument#*=} ;;
    --out=-*) out=./${argument#*=} ;; # or it would be an option of what compares
    --out=?*) out=${argument#*=} ;;
    -*) options+=("$argument") ;;
    *) sides+=("$argument") ;;
  esac
done
if ((${#sides[@]} != 2)) || [[ ! $runs =~ ^[0-9]+$ ]]; then
  echo "run: compare: ${*:-nothing} (allowed: two revisions or programs, --runs=N, --out=DIR," \
    "options of bench)" >&2
  exit 2
fi
programs=("$(program_of "${sides[0]}")")
programs+=("$(program_of "${sides[1]}")")
lists=("" "")
letters=(a b)
for ((k = 1; k <= runs; ++k)); do
  echo "run: compare: run $k of $runs of ${sides[0]}, then of ${sides[1]}" >&2
  for side in 0 1; do
    folder=$out/${letters[side]}$k
    status=0
    # Its progress is shown, its table would hide the comparison.
    "${programs[side]}" "${options[@]}" --out="$folder" >/dev/null || status=$?
    ((status <= 1)) || exit "$status" # 1: some case is not ok, which the comparison reports
    lists[side]+=,$folder
  done
done
exec "$trees/release/bench/bench" compare --names="${sides[0]//,/\\,},${sides[1]//,/\\,}" "${lists[0]#,}" "${lists[1]#,}"
