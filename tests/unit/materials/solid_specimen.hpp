#pragma once
/// One material point in space that is deformed step by step.

#include <mpm/materials/hypoelastic_solid.hpp>

#include "specimen.hpp"

namespace mpm {

class SolidSpecimen {
 public:
  explicit SolidSpecimen(std::optional<YieldConstants> yield = {}, double volume = 1)
      : law_(make_hypoelastic_solid(wall, density, yield)), state_(law_->state_columns())
  {
    state_.resize(lane_count);
    for (int lane = 0; lane < lane_count; ++lane) {
      state_(0, lane) = volume;
      law_->initialise(state_, lane);
    }
  }

  /// F becomes f F in one step.
  void apply(const Eigen::Matrix3d& f)
  {
    constexpr double dt = 1.0 / 1024;  // a power of two: I + dt L is f to the last bit
    alignas(lane_alignment) double gradient[9 * lane_count];
    for (int lane = 0; lane < lane_count; ++lane)
      for (int k = 0; k < 9; ++k)
        gradient[k * lane_count + lane] = (f(k % 3, k / 3) - (k % 4 == 0)) / dt;
    law_->update(state_.block(0), 1, gradient, dt, force_);
  }
  /// A step whose midpoint strain increment is this one, without spin.
  void strain(const Eigen::Matrix3d& e)
  {
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    apply(one + (one - e / 2).inverse() * e);
  }

  Eigen::Matrix3d cauchy() const
  {
    alignas(lane_alignment) double stress[6 * lane_count];
    law_->cauchy_stress(state_.block(0), stress);
    return tensor(stress);
  }
  Eigen::Matrix3d kirchhoff() const
  {
    alignas(lane_alignment) double stress[6 * lane_count];
    law_->force_stress(state_.block(0), 1, stress);
    return tensor(stress) / state_(0, 0);
  }
  /// V0 tau as the last update left it.
  Eigen::Matrix3d force() const { return tensor(force_); }
  double column(const std::string& name) const { return state_(state_.find(name), 0); }
  double elastic_energy() const { return law_->elastic_energy(state_.block(0))[0]; }

 private:
  /// Of the last lane.
  static Eigen::Matrix3d tensor(const double* s)
  {
    const auto at = [&](int k) { return s[(k + 1) * lane_count - 1]; };
    Eigen::Matrix3d m;
    m << at(0), at(3), at(5), at(3), at(1), at(4), at(5), at(4), at(2);
    return m;
  }

  std::unique_ptr<Law<3>> law_;
  ColumnGroup state_;
  alignas(lane_alignment) double force_[6 * lane_count];
};

inline Eigen::Matrix3d in_space(const Eigen::Matrix2d& m, double zz)
{
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  result.topLeftCorner<2, 2>() = m;
  result(2, 2) = zz;
  return result;
}

inline Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle)
{
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

MATCHER_P2(IsNearTensor, expected, tolerance, "")
{
  *result_listener << "off by " << (arg - expected).cwiseAbs().maxCoeff();
  return (arg - expected).cwiseAbs().maxCoeff() <= tolerance;
}

}  // namespace mpm
