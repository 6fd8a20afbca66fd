#!/usr/bin/env bash
# Builds the peers that are compiled:  build.sh FOLDER
set -euo pipefail
peers=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mkdir -p "$1"

siconos=/usr/include/siconos
version=$(dpkg-query --show --showformat='${Version}' libsiconos-numerics-dev)
g++ -std=c++20 -O2 -Wall -Wextra -DSICONOS_VERSION="\"$version\"" -isystem "$siconos" \
  -isystem "$siconos/numerics" -isystem /usr/include/hdf5/serial "$peers/siconos/siconos.cpp" \
  -o "$1/siconos" -lsiconos_numerics -lhdf5_serial

(cd "$peers/fortran" &&
  gfortran -O2 -Wall -I/usr/include -J"$1" contact_sweeps.f90 matrix_market.f90 airy_mumps.f90 \
    -o "$1/airy_mumps" -ldmumps_seq -llapack -lblas)
