#pragma once
/// What bends a brick. Each bends and twists as the plates that it is across its axes: their energy
/// is that of plates without stress across, and the shear strains that these modes would bring
/// along are left out (assumed strains; compare Belytschko & Bindeman 1993, CMAME 105:225, and Puso
/// 2000, IJNME 49:1029). A plate or beam of one brick then bends with the exact stiffness, and a
/// plate twists with it.

#include <mpm/lagrangian/brick.hpp>

#include <cmath>

namespace mpm {

/// Across axis j a brick is a plate, whose fibres along the other two axes i and k are strained in
/// proportion to the distance from its middle, by b^k_i and b^i_k, and which is twisted by
/// b^i_i + b^k_k. What its outermost fibres are strained by stands for each mode: their sum, their
/// difference and the shear for each axis, then what X Y Z strains the edges by along each axis.
template <>
class CellBending<3> {
 public:
  static constexpr int modes = CellDeformation<3>::modes;

  CellBending(const BendingModuli<3>& moduli, const Vec<3>& size)
      : moduli_(moduli), half_{0.5 * size[0], 0.5 * size[1], 0.5 * size[2]}
  {
    // A plate that yields all through bears 3/2 of what its outermost fibres would bear
    // elastically, fibres that are warped along either edge 9/4.
    for (int k = 0; k < modes; ++k)
      fibre_stress_[k] = k >= 9       ? moduli.fibres * 4 / 9
                         : k % 3 == 0 ? moduli.alike / 3
                                      : moduli.opposite / std::sqrt(3.0);
  }
  static Column rest_column() { return {"rest_bending", modes, "1"}; }

  /// For the law, as in bending.hpp. `rest`: columns of what is plastic of the strains, or null.
  [[gnu::always_inline]] void put_trial(const CellDeformation<3>& now, const double* rest,
                                        double* columns) const
  {
    const Strains strains = elastic_strains(now.bending, rest);
    for (int k = 0; k < modes; ++k)
      store(fibre_stress_[k] * strains.of[k], columns + k * lane_count);
    for (int k = 0; k < 9; ++k) store(now.f[k], columns + (modes + k) * lane_count);
  }
  /// Once the law has put what flow takes in place of the stresses: dW/db at 3 m, J m and J m^2,
  /// and what becomes plastic.
  [[gnu::always_inline]] void moments(const Lanes (&bent)[modes], const double* columns,
                                      const Lanes& volume, double* rest,
                                      Lanes (&moment)[modes]) const
  {
    Strains elastic = elastic_strains(bent, rest);
    if (rest)
      for (int k = 0; k < modes; ++k) {
        const Lanes lost = (1 / fibre_stress_[k]) * column(columns, k);
        double* of_mode = rest + k * lane_count;
        store(load(of_mode) + lost, of_mode);
        elastic.of[k] -= lost;
      }
    for (int m = 0; m < modes; ++m) moment[m] = 0.0;
    for (int j = 0; j < 3; ++j) {
      const int i = (j + 1) % 3, k = (j + 2) % 3;
      const Lanes* strain = elastic.of + 3 * j;
      const Lanes unit = volume * (half_[j] / 6.0);
      const Lanes alike = unit * moduli_.alike * strain[0],
                  opposite = unit * moduli_.opposite * strain[1],
                  twist = unit * moduli_.opposite * strain[2];
      moment[3 * k + i] += alike + opposite;
      moment[3 * i + k] += alike - opposite;
      moment[3 * i + i] += twist;
      moment[3 * k + k] += twist;
      moment[9 + j] = volume * (moduli_.fibres * half_[i] * half_[k] / 9.0) * elastic.of[9 + j];
    }
  }
  /// J
  void add_energy(const Lanes (&bent)[modes], const double* rest, const Lanes& volume,
                  Lanes& sum) const
  {
    const Squares squares(elastic_strains(bent, rest));
    sum += volume * (alike_energy(squares) + other_energy(squares));
  }

 private:
  struct Strains {
    Lanes of[modes];
  };
  /// Sums over the axes.
  struct Squares {
    Lanes alike = 0.0, opposite = 0.0, warping = 0.0;
    [[gnu::always_inline]] explicit Squares(const Strains& strains)
    {
      for (int j = 0; j < 3; ++j) {
        const Lanes* s = strains.of + 3 * j;
        alike += s[0] * s[0];
        opposite += s[1] * s[1] + s[2] * s[2];
        warping += strains.of[9 + j] * strains.of[9 + j];
      }
    }
  };
  [[gnu::always_inline]] Strains elastic_strains(const Lanes (&bent)[modes],
                                                 const double* rest) const
  {
    Strains strains;
    for (int j = 0; j < 3; ++j) {
      const int i = (j + 1) % 3, k = (j + 2) % 3;
      const Lanes first = half_[j] * bent[3 * k + i], second = half_[j] * bent[3 * i + k];
      strains.of[3 * j] = first + second;
      strains.of[3 * j + 1] = first - second;
      strains.of[3 * j + 2] = half_[j] * (bent[3 * i + i] + bent[3 * k + k]);
      strains.of[9 + j] = half_[i] * half_[k] * bent[9 + j];
    }
    if (rest)
      for (int k = 0; k < modes; ++k) strains.of[k] -= column(rest, k);
    return strains;
  }
  /// Pa
  Lanes alike_energy(const Squares& squares) const { return moduli_.alike / 12 * squares.alike; }
  Lanes other_energy(const Squares& squares) const
  {
    return moduli_.opposite / 12 * squares.opposite + moduli_.fibres / 18 * squares.warping;
  }

  BendingModuli<3> moduli_;
  double half_[3];              ///< m
  double fibre_stress_[modes];  ///< Pa, over what the outermost fibres are strained by
};

}  // namespace mpm
