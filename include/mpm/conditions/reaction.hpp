#pragma once
/// What a condition, a load or a contact gave to the bodies since it was last asked.

#include <mpm/core/archive.hpp>
#include <mpm/core/types.hpp>

#include <utility>

namespace mpm {

/// This rank's nodes only.
template <int Dim>
struct Reaction {
  Vec<Dim> impulse = Vec<Dim>::Zero();  ///< N s, on the body
  double work = 0;                      ///< J, done on the body

  Reaction take() { return std::exchange(*this, Reaction{}); }
  void archive(Archive& archive)
  {
    archive.values("impulse", {impulse.data(), std::size_t(Dim)});
    archive.value("work", work);
  }
};

}  // namespace mpm
