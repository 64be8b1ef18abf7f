#pragma once
#include <span>

namespace mpm {

/// Types of a kind that code is compiled for, one after the other. Each has a `row`.
template <class... Types>
struct TypeList {
};

/// visit.template operator()<Type>() for each.
template <class... Types, class Visit>
void for_each_type(TypeList<Types...>, Visit visit)
{
  (visit.template operator()<Types>(), ...);
}

template <class Row, class... Types>
std::span<const Row> rows_of(TypeList<Types...>)
{
  static constexpr Row rows[] = {Types::row...};
  return rows;
}

}  // namespace mpm
