#include <mpm/parallel/petsc_handles.hpp>

#include <petscdm.h>
#include <petscksp.h>

namespace mpm {

// What PETSc returns is not looked at: a destructor has nobody to tell.

void PetscDestroy::operator()(_p_Vec* vector) const
{
  static_cast<void>(VecDestroy(&vector));
}

void PetscDestroy::operator()(_p_Mat* matrix) const
{
  static_cast<void>(MatDestroy(&matrix));
}

void PetscDestroy::operator()(_p_KSP* solver) const
{
  static_cast<void>(KSPDestroy(&solver));
}

void PetscDestroy::operator()(_p_DM* grid) const
{
  static_cast<void>(DMDestroy(&grid));
}

}  // namespace mpm
