#pragma once
/// Small matrices of lanes, component ij at i + Dim * j.

#include <mpm/core/lanes.hpp>

namespace mpm {

/// Of component ij: what it is multiplied with in the determinant.
template <int Dim>
[[gnu::always_inline]] inline Lanes cofactor(const Lanes (&a)[Dim * Dim], int i, int j)
{
  if constexpr (Dim == 2) {
    const Lanes other = a[(1 - i) + 2 * (1 - j)];
    return i == j ? other : -other;
  } else {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return a[i1 + 3 * j1] * a[i2 + 3 * j2] - a[i1 + 3 * j2] * a[i2 + 3 * j1];
  }
}

template <int Dim>
[[gnu::always_inline]] inline Lanes determinant(const Lanes (&a)[Dim * Dim])
{
  Lanes sum = 0.0;
  for (int j = 0; j < Dim; ++j) sum += a[Dim * j] * cofactor<Dim>(a, 0, j);
  return sum;
}

/// Of a matrix whose determinant is not 0.
template <int Dim>
[[gnu::always_inline]] inline void invert(const Lanes (&a)[Dim * Dim], Lanes (&inverse)[Dim * Dim])
{
  const Lanes scale = 1.0 / determinant<Dim>(a);
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) inverse[j + Dim * i] = scale * cofactor<Dim>(a, i, j);
}

}  // namespace mpm
