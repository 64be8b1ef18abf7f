#pragma once
/// Index of a material by the name that a shape or a gray band gives it.

#include <mpm/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::micrograph {

class MaterialNames {
 public:
  /// Throws InputError for no material, or more than a lattice can number.
  explicit MaterialNames(const std::vector<scene::Material>& materials);

  /// Lattice::empty for "void"; the only material for "". `key` is the place in the scene.
  std::int8_t index(const std::string& name, std::string_view key) const;

 private:
  std::vector<std::string> names_;
};

}  // namespace mpm::micrograph
