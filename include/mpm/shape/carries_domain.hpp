#pragma once

namespace mpm {

/// Shape functions whose weights depend on a domain that each particle carries with it, and not on
/// its place alone: their weights are no tensor products (transfer/domain_stencil.hpp).
template <class Shape>
concept CarriesDomain = requires
{
  requires Shape::carries_domain;
};

}  // namespace mpm
