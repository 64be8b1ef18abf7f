#pragma once
#include <mpm/materials/law.hpp>

namespace mpm {

/// A material and its particles on this rank.
template <int Dim>
struct Body {
  std::string name;
  int material = 0;  ///< index into the scene's materials
  double density = 0;
  std::unique_ptr<Law<Dim>> law;
  ParticleStore particles;
  int field = 0;  ///< velocity field of the nodes that it moves in
};

}  // namespace mpm
