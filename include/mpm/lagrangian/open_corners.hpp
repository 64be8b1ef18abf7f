#pragma once
/// Where a cell's neighbours across corners, in space across edges as well, can come to meet it.

#include <mpm/core/index_box.hpp>

namespace mpm {

/// A neighbour with which a cell shares a node, and no face, can meet it where one of the other
/// cells around what they share is missing. A bit for each way to a neighbour, the first axis
/// fastest; that of the middle: whether there is no cell behind one of the faces.
template <int Dim>
class OpenCorners {
 public:
  OpenCorners() = default;
  explicit OpenCorners(unsigned bits) : bits_(bits) {}
  static OpenCorners all() { return OpenCorners((1u << directions) - 1); }

  /// `is_taken(location)`: whether there is a cell.
  template <class IsTaken>
  OpenCorners(const IndexVec<Dim>& location, const IsTaken& is_taken)
  {
    const IndexVec<Dim> one = IndexVec<Dim>::Constant(1);
    for_each_index(IndexBox<Dim>{-one, 2 * one}, [&](const IndexVec<Dim>& way) {
      const LocalIndex steps = way.cwiseAbs().sum();
      if (steps == 1 && !is_taken(IndexVec<Dim>(location + way))) set(IndexVec<Dim>::Zero());
      if (steps < 2) return;
      bool open = false;
      for_each_index(IndexBox<Dim>{way.cwiseMin(0), (way.cwiseMax(0).array() + 1).matrix()},
                     [&](const IndexVec<Dim>& between) {
                       if (between.cwiseAbs().sum() > 0 && between != way)
                         open = open || !is_taken(IndexVec<Dim>(location + between));
                     });
      if (open) set(way);
    });
  }

  /// `way` to a neighbour with which no face is shared.
  bool towards(const IndexVec<Dim>& way) const { return bits_ >> number_of(way) & 1; }
  /// Whether it lies behind the outer layer.
  bool is_behind() const { return !towards(IndexVec<Dim>::Zero()); }
  unsigned bits() const { return bits_; }

 private:
  static constexpr int directions = Dim == 2 ? 9 : 27;
  static int number_of(const IndexVec<Dim>& way)
  {
    int number = 0;
    for (int d = Dim - 1; d >= 0; --d) number = 3 * number + way[d] + 1;
    return number;
  }
  void set(const IndexVec<Dim>& way) { bits_ |= 1u << number_of(way); }

  unsigned bits_ = 0;
};

}  // namespace mpm
