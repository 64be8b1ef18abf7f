#pragma once
/// What several loads have in common.

#include <mpm/conditions/load_rows.hpp>

namespace mpm {

inline KindParameter ramp_time_parameter()
{
  return {.key = "ramp_time",
          .help = "smooth rise of the load; 0: at once",
          .quantity = Quantity::time,
          .bound = at_least(0),
          .fallback = 0.0,
          .example = 1e-6};
}

template <int Dim>
Vec<Dim> vector_of(const ParameterValues& values, std::string_view key)
{
  return Eigen::Map<const Vec<Dim>>(values.vector(key).data());
}

}  // namespace mpm
