#pragma once
#include <stdexcept>

#include <petscsys.h>

namespace mpm {

/// PETSc returns codes; an error in its own calls is our mistake or a broken installation.
inline void petsc_check(PetscErrorCode code)
{
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string("PETSc failed: ") + (text ? text : "unknown error"));
}

}  // namespace mpm
