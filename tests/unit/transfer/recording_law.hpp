#pragma once
/// A law that does little: linear elasticity of the plain velocity gradient, which it remembers.

#include <mpm/materials/law.hpp>

namespace mpm {

template <int Dim>
class RecordingLaw final : public Law<Dim> {
 public:
  static constexpr int components = symmetric_components<Dim>;
  static constexpr int stress = 1, gradient = 1 + components;
  static constexpr int width = gradient + Dim * Dim;
  static constexpr double lambda = 30, mu = 20;  // Pa

  /// Row and column of a stored component.
  static std::pair<int, int> place(int component)
  {
    constexpr int plane[3][2] = {{0, 0}, {1, 1}, {0, 1}};
    constexpr int space[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
    const int(&row)[2] = Dim == 2 ? plane[component % 3] : space[component];
    return {row[0], row[1]};
  }

  std::vector<Column> state_columns() const override
  {
    return {{"initial_volume", 1, "m3"},
            {"stress", components, "Pa"},
            {"velocity_gradient", Dim * Dim, "1/s"}};
  }
  void initialise(ColumnGroup&, LocalIndex) const override {}

  void update(double* state, int blocks, const double* l, double dt, double* force) const override
  {
    for (int b = 0; b < blocks; ++b, l += Dim * Dim * lane_count)
      for (int lane = 0; lane < lane_count; ++lane) {
        double* s = state + b * width * lane_count + lane;
        const auto at = [&](int i, int j) { return l[(i + Dim * j) * lane_count + lane]; };
        double trace = 0;
        for (int d = 0; d < Dim; ++d) trace += at(d, d);
        for (int c = 0; c < components; ++c) {
          const auto [i, j] = place(c);
          s[(stress + c) * lane_count] +=
              dt * (mu * (at(i, j) + at(j, i)) + (i == j ? lambda * trace : 0));
        }
        for (int k = 0; k < Dim * Dim; ++k)
          s[(gradient + k) * lane_count] = l[k * lane_count + lane];
      }
    force_stress(state, blocks, force);
  }

  void force_stress(const double* state, int blocks, double* force) const override
  {
    for (int b = 0; b < blocks; ++b)
      for (int c = 0; c < components; ++c)
        for (int lane = 0; lane < lane_count; ++lane) {
          const double* s = state + b * width * lane_count + lane;
          force[(b * components + c) * lane_count + lane] = s[0] * s[(stress + c) * lane_count];
        }
  }

  void cauchy_stress(const double*, double*) const override {}
  Lanes elastic_energy(const double*) const override { return 0.0; }
  Lanes volume_ratio(const double*) const override { return 1.0; }
  double wave_speed() const override { return 1; }
  Lanes fastest_wave_squared(const double*) const override { return 1.0; }
};

}  // namespace mpm
