#pragma once
/// What a condition, a load or a contact gave to the bodies since it was last asked, and what it
/// stores.

#include <mpm/core/archive.hpp>
#include <mpm/core/types.hpp>

#include <algorithm>
#include <utility>

namespace mpm {

/// What contact stores, on this rank.
struct ContactSums {
  double energy = 0;           ///< J
  double overlapped_area = 0;  ///< m^2; in space volume, m^3
  /// Of a cell with all of one wall, or of a location with a rigid one: a part of it.
  double deepest_overlap = 0;
  /// Of cells that touch, each counts for either; of particle and wall; of bodies at a node.
  GlobalIndex pairs = 0;
  double friction_work = 0;  ///< J, lost since the start

  ContactSums& operator+=(const ContactSums& other)
  {
    energy += other.energy;
    overlapped_area += other.overlapped_area;
    deepest_overlap = std::max(deepest_overlap, other.deepest_overlap);
    pairs += other.pairs;
    friction_work += other.friction_work;
    return *this;
  }
};

/// This rank's nodes only.
template <int Dim>
struct Reaction {
  Vec<Dim> impulse = Vec<Dim>::Zero();  ///< N s, on the body
  double work = 0;                      ///< J, done on the body

  Reaction take() { return std::exchange(*this, Reaction{}); }
  void archive(Archive& archive)
  {
    archive.values("impulse", {impulse.data(), std::size_t(Dim)}, Over::sum);
    archive.value("work", work, Over::sum);
  }
};

}  // namespace mpm
