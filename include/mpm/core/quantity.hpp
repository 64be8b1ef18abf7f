#pragma once
namespace mpm {

/// What a number measures, hence which units it may carry (units.hpp).
enum class Quantity {
  number,    ///< a plain number: a count, a gray level, a ratio
  fraction,  ///< dimensionless, may be given in %
  length,
  time,
  velocity,
  pressure,
  density,
  angle,
  acceleration,
  rate  ///< per time
};

}  // namespace mpm
