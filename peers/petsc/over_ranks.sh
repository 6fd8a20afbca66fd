#!/bin/sh
# over_ranks.sh RANKS SCRATCH PROGRAM [ARGUMENT...]: the program on so many ranks of this machine, by
# mpirun or what AIRYBENCH_MPIRUN says instead, the number of ranks behind it ("srun -n").
# What Open MPI keeps in files goes to SCRATCH/mpi: with the folder it is gone, however the ranks ended.
ranks=$1 scratch=$2/mpi
shift 2
mkdir -p "$scratch" || exit 3
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1
# Open MPI 4 has these names, 5 the others: each passes over those that it does not know.
export OMPI_MCA_orte_tmpdir_base="$scratch" OMPI_MCA_btl_vader_backing_directory="$scratch"
export PRTE_MCA_prte_tmpdir_base="$scratch" OMPI_MCA_btl_sm_backing_directory="$scratch"
export OMPI_MCA_orte_execute_quiet=1 PRTE_MCA_prte_execute_quiet=1
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
${AIRYBENCH_MPIRUN:-mpirun --oversubscribe --bind-to none -n} "$ranks" "$@"
status=$?
rm -rf "$scratch"
exit $status
