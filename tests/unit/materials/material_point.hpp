#pragma once
/// One material point of any law, in the plane or in space.

#include <mpm/materials/law.hpp>

#include <Eigen/Dense>
#include <memory>

namespace mpm {

template <int Dim>
class MaterialPoint {
 public:
  using Gradient = Eigen::Matrix<double, Dim, Dim>;

  explicit MaterialPoint(std::shared_ptr<const Law<Dim>> law, double volume = 1)
      : law_(std::move(law)), state_(law_->state_columns())
  {
    state_.resize(lane_count);
    for (int lane = 0; lane < lane_count; ++lane) {
      state_(0, lane) = volume;
      law_->initialise(state_, lane);
    }
  }

  /// F becomes f F in one step.
  void apply(const Gradient& f)
  {
    constexpr double dt = 1.0 / 1024;  // a power of two: I + dt L is f to the last bit
    alignas(lane_alignment) double gradient[Dim * Dim * lane_count];
    const Gradient rate = (f - Gradient::Identity()) / dt;
    for (int lane = 0; lane < lane_count; ++lane)
      for (int k = 0; k < Dim * Dim; ++k) gradient[k * lane_count + lane] = rate(k % Dim, k / Dim);
    law_->update(state_.block(0), 1, gradient, dt, force_);
    deformation_ = f * deformation_;
  }
  /// F becomes `end` in so many equal parts of the difference.
  void go_to(const Gradient& end, int steps)
  {
    const Gradient start = deformation_;
    for (int k = 1; k <= steps; ++k)
      apply((start + double(k) / steps * (end - start)) * deformation_.inverse());
  }

  /// All six components in 2D too.
  Eigen::Matrix3d cauchy() const
  {
    alignas(lane_alignment) double s[6 * lane_count];
    law_->cauchy_stress(state_.block(0), s);
    return in_space(s);
  }
  Gradient kirchhoff() const
  {
    alignas(lane_alignment) double s[symmetric_components<Dim> * lane_count];
    law_->force_stress(state_.block(0), 1, s);
    return tensor(s) / state_(0, 0);
  }
  /// V0 tau as the last update left it.
  Gradient force() const { return tensor(force_); }
  bool has(const std::string& column) const
  {
    for (const Column& each : law_->state_columns())
      if (each.name == column) return true;
    return false;
  }
  double column(const std::string& name) const { return state_(state_.find(name), 0); }
  /// Six columns xx, yy, zz, xy, yz, xz.
  Eigen::Matrix3d symmetric_columns(const std::string& name) const
  {
    return in_space(state_.block(0) + state_.find(name) * lane_count);
  }
  double dissipated() const { return has("plastic_work") ? column("plastic_work") : 0; }
  double elastic_energy() const { return law_->elastic_energy(state_.block(0))[0]; }
  double volume_ratio() const { return law_->volume_ratio(state_.block(0))[lane_count - 1]; }
  /// m/s
  double fastest_wave() const
  {
    return std::sqrt(law_->fastest_wave_squared(state_.block(0))[lane_count - 1]);
  }
  const Gradient& deformation() const { return deformation_; }
  const Law<Dim>& law() const { return *law_; }

 private:
  /// Of the last lane.
  static Eigen::Matrix3d in_space(const double* s)
  {
    const auto at = [&](int k) { return s[(k + 1) * lane_count - 1]; };
    Eigen::Matrix3d m;
    m << at(0), at(3), at(5), at(3), at(1), at(4), at(5), at(4), at(2);
    return m;
  }
  static Gradient tensor(const double* s)
  {
    if constexpr (Dim == 3) return in_space(s);
    const auto at = [&](int k) { return s[(k + 1) * lane_count - 1]; };
    Gradient m;
    m(0, 0) = at(0);
    m(1, 1) = at(1);
    m(0, 1) = m(1, 0) = at(2);
    return m;
  }

  std::shared_ptr<const Law<Dim>> law_;
  ColumnGroup state_;
  Gradient deformation_ = Gradient::Identity();
  alignas(lane_alignment) double force_[symmetric_components<Dim> * lane_count] = {};
};

}  // namespace mpm
