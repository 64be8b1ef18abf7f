# Sourced before mpirun by the scripts that run on ONE machine (quickstart, tests): settings under
# which Open MPI 4 and 5 start in a container or on a laptop. A setting that is already there stays.
# Not for clusters: the shared-memory transport below cannot reach a second node.

set_if_unset() {
  eval "[ -n \"\${$1+set}\" ]" || export "$1=$2"
}

# Root is the usual account in a container, and Open MPI asks twice whether that is meant.
set_if_unset OMPI_ALLOW_RUN_AS_ROOT 1
set_if_unset OMPI_ALLOW_RUN_AS_ROOT_CONFIRM 1

# More ranks than cores (first Open MPI 4, then 5), and idle ranks give way to busy ones.
set_if_unset OMPI_MCA_rmaps_base_oversubscribe 1
set_if_unset PRTE_MCA_rmaps_default_mapping_policy :oversubscribe
set_if_unset OMPI_MCA_mpi_yield_when_idle 1

# Two runs at the same time would both be bound to core 0 (first Open MPI 4, then 5).
set_if_unset OMPI_MCA_hwloc_base_binding_policy none
set_if_unset PRTE_MCA_hwloc_default_binding_policy none

# Shared memory only; single-copy needs ptrace, which containers forbid.
set_if_unset OMPI_MCA_btl self,vader
set_if_unset OMPI_MCA_btl_vader_single_copy_mechanism none

# One thread per rank: a threaded BLAS under every rank would ask for ranks x cores threads.
set_if_unset OMP_NUM_THREADS 1

unset -f set_if_unset
