#pragma once
/// One material point that is deformed step by step.

#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic.hpp>

#include <Eigen/Dense>

#include <gmock/gmock.h>

namespace mpm {

// Cell wall of the founding paper with a finite yield stress, MPa.
inline constexpr IsotropicConstants wall{10600, 0.33};
inline constexpr double yield_stress = 500;
inline constexpr double density = 1500;

class Specimen {
 public:
  explicit Specimen(std::shared_ptr<const Law<2>> law, double volume = 1)
      : law_(std::move(law)), state_(law_->state_columns())
  {
    state_.resize(lane_count);
    for (int lane = 0; lane < lane_count; ++lane) {
      state_(0, lane) = volume;
      law_->initialise(state_, lane);
    }
  }

  /// F becomes f F in one step.
  void apply(const Eigen::Matrix2d& f)
  {
    // 1/dt is a power of two: I + dt L is f to the last bit.
    constexpr double dt = 1.0 / 1024;
    alignas(lane_alignment) double gradient[4 * lane_count];
    for (int lane = 0; lane < lane_count; ++lane)
      for (int k = 0; k < 4; ++k)
        gradient[k * lane_count + lane] = (f(k % 2, k / 2) - (k % 3 == 0)) / dt;
    law_->update(state_.block(0), 1, gradient, dt, force_);
    deformation_ = f * deformation_;
  }
  /// A step whose midpoint strain increment is this one, without spin: G = E for
  /// dt L = (I - E / 2)^-1 E.
  void strain(double xx, double yy, double shear)
  {
    Eigen::Matrix2d e;
    e << xx, shear / 2, shear / 2, yy;
    const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
    apply(one + (one - e / 2).inverse() * e);
  }

  /// xx, yy, zz, xy
  Eigen::Vector4d cauchy() const
  {
    alignas(lane_alignment) double stress[6 * lane_count];
    law_->cauchy_stress(state_.block(0), stress);
    return {stress[0], stress[lane_count], stress[2 * lane_count], stress[3 * lane_count]};
  }
  /// xx, yy, zz, xy; in plane strain (in plane stress J holds the thickness, but zz is zero).
  Eigen::Vector4d kirchhoff() const
  {
    alignas(lane_alignment) double tau[3 * lane_count];
    law_->force_stress(state_.block(0), 1, tau);
    const double zz = cauchy()[2] * deformation_.determinant();
    return Eigen::Vector4d(tau[0], tau[lane_count], 0, tau[2 * lane_count]) / state_(0, 0) +
           Eigen::Vector4d(0, 0, zz, 0);
  }
  double column(const std::string& name) const { return state_(state_.find(name), 0); }
  double plastic_strain() const { return column("plastic_strain"); }
  double elastic_energy() const { return law_->elastic_energy(state_.block(0))[0]; }
  const Eigen::Matrix2d& deformation() const { return deformation_; }

 private:
  std::shared_ptr<const Law<2>> law_;
  ColumnGroup state_;
  Eigen::Matrix2d deformation_ = Eigen::Matrix2d::Identity();
  alignas(lane_alignment) double force_[3 * lane_count];
};

enum class Form { logarithmic, rate };

inline std::string form_name(Form form)
{
  return form == Form::rate ? "Rate" : "Logarithmic";
}

inline std::shared_ptr<const Law<2>> elastic_law(Form form, PlaneAssumption plane)
{
  if (form == Form::logarithmic) return make_hencky(plane, wall, density, std::nullopt);
  return make_hypoelastic(plane, PlaneStiffness::isotropic(plane, wall), density);
}

inline std::shared_ptr<const Law<2>> plastic_law(Form form, PlaneAssumption plane,
                                                 double hardening = 0, double yield = yield_stress)
{
  if (form == Form::logarithmic)
    return make_hencky(plane, wall, density, YieldConstants{yield, hardening});
  return make_hypoelastic_von_mises(plane, wall, {yield, hardening}, density);
}

inline Eigen::Matrix2d rotation(double angle)
{
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

inline Eigen::Matrix2d matrix(double xx, double xy, double yx, double yy)
{
  Eigen::Matrix2d m;
  m << xx, xy, yx, yy;
  return m;
}

/// exp of a symmetric tensor.
inline Eigen::Matrix2d exponential(const Eigen::Matrix2d& strain)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spectrum(strain);
  return spectrum.eigenvectors() * spectrum.eigenvalues().array().exp().matrix().asDiagonal() *
         spectrum.eigenvectors().transpose();
}

/// R S R^T of xx, yy, zz, xy.
inline Eigen::Vector4d turned(const Eigen::Vector4d& s, const Eigen::Matrix2d& r)
{
  const Eigen::Matrix2d t = r * matrix(s[0], s[3], s[3], s[1]) * r.transpose();
  return {t(0, 0), t(1, 1), s[2], t(0, 1)};
}

MATCHER_P2(IsNear, expected, tolerance, "")
{
  *result_listener << "off by " << (arg - expected).cwiseAbs().maxCoeff() << "; is "
                   << arg.transpose();
  return (arg - expected).cwiseAbs().maxCoeff() <= tolerance;
}

/// Every test of a law for both its forms and both plane assumptions.
class EveryLaw : public testing::TestWithParam<std::tuple<Form, PlaneAssumption>> {
 protected:
  Form form() const { return std::get<0>(GetParam()); }
  PlaneAssumption plane() const { return std::get<1>(GetParam()); }
};
inline auto every_law()
{
  return testing::Combine(testing::Values(Form::logarithmic, Form::rate),
                          testing::Values(PlaneAssumption::strain, PlaneAssumption::stress));
}
inline std::string law_name(const testing::TestParamInfo<EveryLaw::ParamType>& info)
{
  return form_name(std::get<0>(info.param)) +
         (std::get<1>(info.param) == PlaneAssumption::strain ? "PlaneStrain" : "PlaneStress");
}

}  // namespace mpm
