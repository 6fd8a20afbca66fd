#!/usr/bin/env bash
# Builds the peers that are compiled:  build.sh FOLDER
set -euo pipefail
peers=$(dirname "$(realpath -- "${BASH_SOURCE[0]}")")
mkdir -p "$1"

siconos=/usr/include/siconos
if [[ -d $siconos ]]; then # not packaged in every release of Debian
  version=$(dpkg-query --show --showformat='${Version}' libsiconos-numerics-dev)
  # shellcheck disable=SC2046 # flags are words
  g++ -std=c++20 -O2 -Wall -Wextra -DSICONOS_VERSION="\"$version\"" -isystem "$siconos" \
    -isystem "$siconos/numerics" "$peers/siconos/siconos.cpp" -o "$1/siconos" -lsiconos_numerics \
    $(pkg-config --cflags --libs hdf5-serial)
fi

(cd "$peers/fortran" &&
  gfortran -O2 -Wall -I/usr/include -J"$1" contact_sweeps.f90 matrix_market.f90 airy_mumps.f90 \
    -o "$1/airy_mumps" -ldmumps_seq -llapack -lblas)
