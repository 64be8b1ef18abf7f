#pragma once
/// Eigenvalues and eigenvectors of symmetric tensors in space, lane by lane.

#include <mpm/materials/space_tensor.hpp>

namespace mpm {

/// By cyclic Jacobi rotations (Golub & Van Loan 2013, 8.5): slow, and exact to rounding for any
/// eigenvalues, close ones too.
class Spectrum {
 public:
  [[gnu::noinline]] explicit Spectrum(const Symmetric& s)
  {
    a_ = {{{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}};
    v_ = Tensor::identity();
    constexpr int most_sweeps = 10;  // five do; NaN would never end
    for (int sweep = 0; sweep < most_sweeps && !stdx::all_of(is_diagonal()); ++sweep) {
      rotate(0, 1);
      rotate(0, 2);
      rotate(1, 2);
    }
  }

  /// The smallest eigenvalue.
  Lanes least() const { return stdx::min(stdx::min(a_.a[0][0], a_.a[1][1]), a_.a[2][2]); }
  Lanes largest() const { return stdx::max(stdx::max(a_.a[0][0], a_.a[1][1]), a_.a[2][2]); }
  /// Sum of f(eigenvalue) v (x) v.
  template <class Function>
  Symmetric function(Function f) const
  {
    const Lanes value[3] = {f(a_.a[0][0]), f(a_.a[1][1]), f(a_.a[2][2])};
    const auto at = [&](int i, int j) {
      Lanes sum = 0.0;
      for (int k = 0; k < 3; ++k) sum += value[k] * v_.a[i][k] * v_.a[j][k];
      return sum;
    };
    return {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(0, 2)};
  }

 private:
  LaneMask is_diagonal() const
  {
    Lanes off = 0.0, all = 0.0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      off += a_.a[i][j] * a_.a[i][j];
      all += a_.a[i][i] * a_.a[i][i];
    }
    return off <= 1e-36 * all;
  }
  /// Makes element p, q zero.
  void rotate(int p, int q)
  {
    const int r = 3 - p - q;
    const Lanes off = a_.a[p][q], difference = a_.a[q][q] - a_.a[p][p];
    Lanes sign = 1.0;
    stdx::where(difference < 0.0, sign) = -1.0;
    // The tangent of the angle, of at most 45 degrees. The last addend is for 0 / 0.
    const Lanes t =
        2.0 * sign * off /
        (stdx::abs(difference) + stdx::sqrt(difference * difference + 4.0 * off * off) + 1e-300);
    const Lanes c = 1.0 / stdx::sqrt(1.0 + t * t), s = t * c;
    a_.a[p][p] -= t * off;
    a_.a[q][q] += t * off;
    a_.a[p][q] = a_.a[q][p] = 0.0;
    turn(a_.a[r][p], a_.a[r][q], c, s);
    a_.a[p][r] = a_.a[r][p];
    a_.a[q][r] = a_.a[r][q];
    for (int k = 0; k < 3; ++k) turn(v_.a[k][p], v_.a[k][q], c, s);
  }
  static void turn(Lanes& x, Lanes& y, const Lanes& c, const Lanes& s)
  {
    const Lanes old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  }

  Tensor a_, v_;
};

}  // namespace mpm
