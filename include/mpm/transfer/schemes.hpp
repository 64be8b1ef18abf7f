#pragma once
/// The lists of transfer schemes and update orders. A new scheme is a header here and a line in
/// schemes.list.

#include <mpm/core/one_of.hpp>
#include <mpm/shape/shapes.hpp>
#include <mpm/transfer/scheme.hpp>

namespace mpm {

template <>
std::span<const SchemeRow> list_of<SchemeRow>();

enum class UpdateOrderKind {
  musl,  ///< modified update stress last: velocity gradient of the re-mapped grid velocity
  usf,   ///< update stress first
  usl    ///< update stress last, without re-mapping
};

struct UpdateOrderRow {
  UpdateOrderKind kind;
  std::string_view keyword;
  std::string_view help;
  std::string_view words;  ///< in the plan of a run
  /// Of the order; without one the scheme's holds.
  std::optional<double> StableCfl::*stable_cfl;
};

template <>
std::span<const UpdateOrderRow> list_of<UpdateOrderRow>();

/// Largest stable step in units of h / c; nothing where no step is stable.
std::optional<double> stable_cfl(const ShapeRow& shape, const SchemeRow& scheme,
                                 const UpdateOrderRow& order);

}  // namespace mpm
