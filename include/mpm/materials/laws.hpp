#pragma once
/// The list of material laws. A new law is a file in src/materials and a line in laws.list there.

#include <mpm/core/one_of.hpp>
#include <mpm/core/parameters.hpp>
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/law.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// All that the program knows of a law. A law that makes stress has a parameter `density`, kg/m^3.
struct LawRow {
  std::string keyword;
  std::string help;
  std::vector<KindParameter> parameters;
  /// None for a law that is not there in the plane, or in space; for neither: it cannot be
  /// deformed.
  std::unique_ptr<Law<2>> (*in_plane)(const ParameterValues&, PlaneAssumption) = nullptr;
  std::unique_ptr<Law<3>> (*in_space)(const ParameterValues&) = nullptr;
  /// What no single bound can tell.
  std::optional<Contradiction> (*check)(const ParameterValues&) = nullptr;

  bool deformable() const { return in_plane || in_space; }
  bool is_there(int dimensions) const { return dimensions == 2 ? bool(in_plane) : bool(in_space); }
  bool has(std::string_view key) const;
};

template <>
std::span<const LawRow> list_of<LawRow>();

/// Keywords of those that are there in the plane, or in space.
std::vector<std::string> laws_there(int dimensions);

/// The law with these values; `plane` is looked at for Dim = 2. Throws InputError where there is no
/// such law in the plane or in space, naming those that are.
template <int Dim>
std::unique_ptr<Law<Dim>> make_law(const LawRow& law, const ParameterValues& values,
                                   PlaneAssumption plane);

}  // namespace mpm
