#pragma once
/// Between columns of lanes (one value of many particles) and rows of two or four (many values of
/// one particle), in registers: reading single values that were stored as lanes, or lanes that were
/// stored one by one, would wait for the store to finish; and a row is read at once, where the
/// gather instructions of most processors read value by value.

#include <mpm/core/lanes.hpp>

#include <cstddef>
#include <cstring>

namespace mpm {

namespace transpose_detail {

template <int N>
using Vector [[gnu::vector_size(8 * N)]] = double;

template <int N>
inline Vector<N> read(const double* from)
{
  Vector<N> v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
template <class V>
inline void write(const V& v, double* to)
{
  std::memcpy(to, &v, sizeof v);
}

template <int N>  // lane_count; a parameter so that branches for other widths are not compiled
[[gnu::always_inline]] inline void to_rows(const Vector<N>& va, const Vector<N>& vb,
                                           const Vector<N>& vc, const Vector<N>& vd, double* rows,
                                           std::size_t stride)
{
  using Column = Vector<N>;
  if constexpr (N == 8) {
    const Column even_ab = __builtin_shufflevector(va, vb, 0, 8, 2, 10, 4, 12, 6, 14);
    const Column odd_ab = __builtin_shufflevector(va, vb, 1, 9, 3, 11, 5, 13, 7, 15);
    const Column even_cd = __builtin_shufflevector(vc, vd, 0, 8, 2, 10, 4, 12, 6, 14);
    const Column odd_cd = __builtin_shufflevector(vc, vd, 1, 9, 3, 11, 5, 13, 7, 15);
    const Column r02 = __builtin_shufflevector(even_ab, even_cd, 0, 1, 8, 9, 2, 3, 10, 11);
    const Column r46 = __builtin_shufflevector(even_ab, even_cd, 4, 5, 12, 13, 6, 7, 14, 15);
    const Column r13 = __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 8, 9, 2, 3, 10, 11);
    const Column r57 = __builtin_shufflevector(odd_ab, odd_cd, 4, 5, 12, 13, 6, 7, 14, 15);
    const Column* const pairs[4] = {&r02, &r13, &r46, &r57};
    for (int p = 0; p < 4; ++p) {
      const int lane = p / 2 * 4 + p % 2;
      write(__builtin_shufflevector(*pairs[p], *pairs[p], 0, 1, 2, 3), rows + lane * stride);
      write(__builtin_shufflevector(*pairs[p], *pairs[p], 4, 5, 6, 7), rows + (lane + 2) * stride);
    }
  } else if constexpr (N == 4) {
    const Column even_ab = __builtin_shufflevector(va, vb, 0, 4, 2, 6);
    const Column odd_ab = __builtin_shufflevector(va, vb, 1, 5, 3, 7);
    const Column even_cd = __builtin_shufflevector(vc, vd, 0, 4, 2, 6);
    const Column odd_cd = __builtin_shufflevector(vc, vd, 1, 5, 3, 7);
    write(__builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5), rows);
    write(__builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5), rows + stride);
    write(__builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7), rows + 2 * stride);
    write(__builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7), rows + 3 * stride);
  } else {
    write(__builtin_shufflevector(va, vb, 0, 2), rows);
    write(__builtin_shufflevector(vc, vd, 0, 2), rows + 2);
    write(__builtin_shufflevector(va, vb, 1, 3), rows + stride);
    write(__builtin_shufflevector(vc, vd, 1, 3), rows + stride + 2);
  }
}

template <int N>
[[gnu::always_inline]] inline void to_rows(const Vector<N>& va, const Vector<N>& vb, double* rows)
{
  if constexpr (N == 8) {
    write(__builtin_shufflevector(va, vb, 0, 8, 1, 9, 2, 10, 3, 11), rows);
    write(__builtin_shufflevector(va, vb, 4, 12, 5, 13, 6, 14, 7, 15), rows + N);
  } else if constexpr (N == 4) {
    write(__builtin_shufflevector(va, vb, 0, 4, 1, 5), rows);
    write(__builtin_shufflevector(va, vb, 2, 6, 3, 7), rows + N);
  } else {
    write(__builtin_shufflevector(va, vb, 0, 2), rows);
    write(__builtin_shufflevector(va, vb, 1, 3), rows + N);
  }
}

/// row(lane): where the row of a lane stands.
template <int N, class Row>
[[gnu::always_inline]] inline void to_columns(const Row& row, Vector<N> (&columns)[2])
{
  const auto both = [&](int first, int second) {
    return __builtin_shufflevector(read<2>(row(first)), read<2>(row(second)), 0, 1, 2, 3);
  };
  if constexpr (N == 8) {
    const Vector<4> r02 = both(0, 2), r46 = both(4, 6), r13 = both(1, 3), r57 = both(5, 7);
    const Vector<N> even = __builtin_shufflevector(r02, r46, 0, 1, 2, 3, 4, 5, 6, 7);
    const Vector<N> odd = __builtin_shufflevector(r13, r57, 0, 1, 2, 3, 4, 5, 6, 7);
    columns[0] = __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14);
    columns[1] = __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15);
  } else if constexpr (N == 4) {
    const Vector<N> even = both(0, 2), odd = both(1, 3);
    columns[0] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    columns[1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
  } else {
    const Vector<N> first = read<N>(row(0)), second = read<N>(row(1));
    columns[0] = __builtin_shufflevector(first, second, 0, 2);
    columns[1] = __builtin_shufflevector(first, second, 1, 3);
  }
}
template <int N, class Row>
[[gnu::always_inline]] inline void to_columns(const Row& row, Vector<N> (&columns)[4])
{
  using Column = Vector<N>;
  if constexpr (N == 8) {
    const auto both = [&](int first, int second) {
      return __builtin_shufflevector(read<4>(row(first)), read<4>(row(second)), 0, 1, 2, 3, 4, 5, 6,
                                     7);
    };
    const Column r02 = both(0, 2), r13 = both(1, 3), r46 = both(4, 6), r57 = both(5, 7);
    const Column ac_low = __builtin_shufflevector(r02, r13, 0, 8, 2, 10, 4, 12, 6, 14);
    const Column bd_low = __builtin_shufflevector(r02, r13, 1, 9, 3, 11, 5, 13, 7, 15);
    const Column ac_high = __builtin_shufflevector(r46, r57, 0, 8, 2, 10, 4, 12, 6, 14);
    const Column bd_high = __builtin_shufflevector(r46, r57, 1, 9, 3, 11, 5, 13, 7, 15);
    columns[0] = __builtin_shufflevector(ac_low, ac_high, 0, 1, 4, 5, 8, 9, 12, 13);
    columns[1] = __builtin_shufflevector(bd_low, bd_high, 0, 1, 4, 5, 8, 9, 12, 13);
    columns[2] = __builtin_shufflevector(ac_low, ac_high, 2, 3, 6, 7, 10, 11, 14, 15);
    columns[3] = __builtin_shufflevector(bd_low, bd_high, 2, 3, 6, 7, 10, 11, 14, 15);
  } else if constexpr (N == 4) {
    const Column r0 = read<N>(row(0)), r1 = read<N>(row(1)), r2 = read<N>(row(2)),
                 r3 = read<N>(row(3));
    const Column ac_low = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
    const Column bd_low = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
    const Column ac_high = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
    const Column bd_high = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    columns[0] = __builtin_shufflevector(ac_low, ac_high, 0, 1, 4, 5);
    columns[1] = __builtin_shufflevector(bd_low, bd_high, 0, 1, 4, 5);
    columns[2] = __builtin_shufflevector(ac_low, ac_high, 2, 3, 6, 7);
    columns[3] = __builtin_shufflevector(bd_low, bd_high, 2, 3, 6, 7);
  } else {
    for (int k = 0; k < 4; k += 2) {
      const Column first = read<N>(row(0) + k), second = read<N>(row(1) + k);
      columns[k] = __builtin_shufflevector(first, second, 0, 2);
      columns[k + 1] = __builtin_shufflevector(first, second, 1, 3);
    }
  }
}

}  // namespace transpose_detail

/// Row `lane`, at rows + lane * stride, becomes {a, b, c, d} of that lane.
[[gnu::always_inline]] inline void to_rows(const Lanes& a, const Lanes& b, const Lanes& c,
                                           const Lanes& d, double* rows, std::size_t stride)
{
  using V = transpose_detail::Vector<lane_count>;
  transpose_detail::to_rows<lane_count>(std::bit_cast<V>(a), std::bit_cast<V>(b),
                                        std::bit_cast<V>(c), std::bit_cast<V>(d), rows, stride);
}

/// Row `lane`, at rows + 2 * lane, becomes {a, b} of that lane.
[[gnu::always_inline]] inline void to_rows(const Lanes& a, const Lanes& b, double* rows)
{
  using V = transpose_detail::Vector<lane_count>;
  transpose_detail::to_rows<lane_count>(std::bit_cast<V>(a), std::bit_cast<V>(b), rows);
}

/// The inverse of `to_rows`, for rows of two or four: columns[k] collects value k of every row;
/// that of a lane stands at row(lane).
template <class Row, int Width>
[[gnu::always_inline]] inline void to_columns(const Row& row, Lanes (&columns)[Width])
{
  transpose_detail::Vector<lane_count> found[Width];
  transpose_detail::to_columns<lane_count>(row, found);
  for (int k = 0; k < Width; ++k) columns[k] = std::bit_cast<Lanes>(found[k]);
}
[[gnu::always_inline]] inline void to_columns(const double* rows, std::size_t stride,
                                              Lanes (&columns)[4])
{
  to_columns([&](int lane) { return rows + lane * stride; }, columns);
}

}  // namespace mpm
