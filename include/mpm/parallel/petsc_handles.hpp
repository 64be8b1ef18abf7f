#pragma once
/// PETSc's objects with an owner that destroys them, without PETSc's headers: those stay in the
/// sources of this folder.

#include <memory>

// Named by PETSc: Vec, Mat, KSP and DM are pointers to these.
struct _p_Vec;
struct _p_Mat;
struct _p_KSP;
struct _p_DM;

namespace mpm {

/// Objects of PETSc die on all ranks in the same order, and before the Session.
struct PetscDestroy {
  void operator()(_p_Vec* vector) const;
  void operator()(_p_Mat* matrix) const;
  void operator()(_p_KSP* solver) const;
  void operator()(_p_DM* grid) const;
};

// `get()` is what PETSc's functions take.
using VectorHandle = std::unique_ptr<_p_Vec, PetscDestroy>;
using MatrixHandle = std::unique_ptr<_p_Mat, PetscDestroy>;
using SolverHandle = std::unique_ptr<_p_KSP, PetscDestroy>;
using GridHandle = std::shared_ptr<_p_DM>;

}  // namespace mpm
