// The common yield surface of stress at the centre and moments, in the plane and in space: beside
// that of fibres that yield all through, and normality.
#include <mpm/materials/bent_flow.hpp>
#include <mpm/materials/brick_flow.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const IsotropicConstants elastic{10e9, 0.3};
constexpr double limit = 50e6;

/// The largest factor up to `outside` for which nothing flows.
template <class Flows>
double largest_below(double outside, Flows flows)
{
  double inside = 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (inside + outside);
    (flows(middle) ? outside : inside) = middle;
  }
  return inside;
}

/// mean, along, shear, bending of the fibres along either axis
using Parts = std::array<double, 5>;

BentStress lanes(const Parts& t)
{
  return {t[0], t[1], t[2], {t[3], t[4]}};
}
Parts parts(const BentStress& t)
{
  return {t.mean[0], t.along[0], t.shear[0], t.bending[0][0], t.bending[1][0]};
}
Parts moduli(PlaneAssumption plane)
{
  const double shear = 3 * elastic.shear_modulus(), e = elastic.youngs_modulus,
               nu = elastic.poisson_ratio;
  if (plane == PlaneAssumption::strain) {
    const double fibres = e / (1 - nu * nu);
    return {shear, shear, shear, fibres, fibres};
  }
  return {e / (2 * (1 - nu)), shear, shear, e * 4 / 3, e * 4 / 3};
}

class BentFlowOf : public ::testing::TestWithParam<PlaneAssumption> {
 protected:
  BentFlow flow(double hardening = 0) const { return {GetParam(), elastic, {limit, hardening}}; }
  Parts any()
  {
    Parts t;
    for (double& part : t) part = uniform_(random_);
    for (const std::size_t k : {3, 4}) t[k] = std::abs(t[k]);
    return t;
  }
  /// On the yield surface: drawn towards the origin by bisection.
  Parts bound(const Parts& direction) const
  {
    const auto scaled = [&direction](double factor) {
      Parts t = direction;
      for (double& part : t) part *= factor;
      return t;
    };
    return scaled(largest_below(10 * limit, [&](double factor) {
      BentStress stress = lanes(scaled(factor));
      return flow()(stress, 0.0).any;
    }));
  }
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Ilyushin 1948: stresses of a section whose fibres are strained at a rate of g + kappa y along
/// themselves and p otherwise.
TEST_P(BentFlowOf, IsThatOfASectionWhoseFibresYieldAllThrough)
{
  const double root = std::sqrt(0.75);
  for (int trial = 0; trial < 200; ++trial) {
    const double g = uniform_(random_), p = uniform_(random_), kappa = 3 * uniform_(random_);
    constexpr int fibres = 2000;
    double along = 0, other = 0, bending = 0;
    for (int k = 0; k < fibres; ++k) {
      const double y = (k + 0.5) / fibres * 2 - 1, rate = g + kappa * y, size = std::hypot(rate, p);
      along += rate / size / fibres;
      other += p / size / fibres;
      bending += 2 * rate / size * y / fibres;  // over that of fibres that yield
    }
    // What lies along the fibres is, in plane stress, part of the mean as well.
    const bool strain = GetParam() == PlaneAssumption::strain;
    const Parts direction = strain ? Parts{0, along, other, std::abs(bending), 0}
                                   : Parts{0.5 * along, root * along, other, std::abs(bending), 0};
    const Parts found = bound(direction);
    const double ratio = std::hypot(found[0], found[1], found[2]) /
                         (limit * std::hypot(direction[0], direction[1], direction[2]));
    EXPECT_GT(ratio, 0.93) << g << " " << p << " " << kappa;
    EXPECT_LT(ratio, 1 + 0.5 * rounded_vertex) << g << " " << p << " " << kappa;
    const double rest = 1 - along * along;
    const Parts straight =
        bound(strain ? Parts{0, along, 0, rest, 0} : Parts{0.5 * along, root * along, 0, rest, 0});
    EXPECT_NEAR(straight[3] / (limit * rest), 1, 0.6 * rounded_vertex);
  }
}

/// Stresses along x that depend on y alone and along y on x alone: the cell bears their means and
/// moments where no two that cross yield.
TEST_P(BentFlowOf, BearsWhatFibresAlongBothAxesCan)
{
  const bool strain = GetParam() == PlaneAssumption::strain;
  const double root = std::sqrt(0.75);
  for (int trial = 0; trial < 200; ++trial) {
    const double n = uniform_(random_), share = 0.5 + 0.5 * uniform_(random_);
    const double size[2] = {share, 1 - share};
    constexpr int fibres = 2000;
    double mean[2] = {}, bending[2] = {};
    for (int axis = 0; axis < 2; ++axis)
      for (int k = 0; k < fibres; ++k) {
        const double y = (k + 0.5) / fibres * 2 - 1, one = y < n ? size[axis] : -size[axis];
        mean[axis] += (axis ? -one : one) / fibres;
        bending[axis] -= 2 * one * y / fibres;  // over that of fibres that yield
      }
    // Largest where the two are opposite.
    const double crossed = strain ? size[0] + size[1] : std::sqrt(1 - size[0] * size[1]);
    Parts direction{0, (mean[0] - mean[1]) / crossed, 0, bending[0] / crossed,
                    bending[1] / crossed};
    if (!strain) {
      direction[0] = 0.5 * (mean[0] + mean[1]) / crossed;
      direction[1] *= root;
    }
    const Parts found = bound(direction);
    const double ratio = found[3] / (limit * direction[3]);
    EXPECT_GT(ratio, strain ? 1 - 1e-3 : 0.93) << n << " " << share;
    EXPECT_LT(ratio, 1 + 0.6 * rounded_vertex) << n << " " << share;
  }
}

/// (t - t*) C^-1 (t_trial - t) >= 0 for every stress t* that is allowed.
TEST_P(BentFlowOf, DissipatesTheMost)
{
  const Parts modulus = moduli(GetParam());
  for (int trial = 0; trial < 200; ++trial) {
    Parts t = bound(any());
    const Parts step = any();
    for (std::size_t k = 0; k < t.size(); ++k) t[k] += 1e-4 * limit * step[k];
    for (const std::size_t k : {3, 4}) t[k] = std::max(t[k], 0.0);
    BentStress stress = lanes(t);
    const BentReturn flowed = flow()(stress, 0.0);
    if (!flowed.any) continue;
    const Parts now = parts(stress);
    EXPECT_GT(flowed.plastic_strain[0], 0);
    for (int other = 0; other < 200; ++other) {
      const Parts allowed = bound(any());
      double work = 0, size = 0;
      for (std::size_t k = 0; k < t.size(); ++k) {
        work += (now[k] - allowed[k]) * (t[k] - now[k]) / modulus[k];
        size += std::abs(t[k] - now[k]) / modulus[k];
      }
      EXPECT_GT(work, -1e-3 * limit * size);
    }
  }
}

/// Along a path of small steps, as the law takes them.
TEST_P(BentFlowOf, EndsOnTheYieldSurfaceAndHardens)
{
  constexpr double hardening = 1e9;
  for (int trial = 0; trial < 20; ++trial) {
    const Parts step = any();
    Parts t{};
    double strain = 0;
    for (int k = 0; k < 2000; ++k) {
      for (std::size_t part = 0; part < t.size(); ++part) t[part] += 4e-3 * limit * step[part];
      BentStress stress = lanes(t);
      strain += flow(hardening)(stress, strain).plastic_strain[0];
      t = parts(stress);
    }
    ASSERT_GT(strain, 1e-3);
    for (const double more : {0.999, 1.001}) {
      Parts scaled = t;
      for (double& part : scaled) part *= more;
      BentStress stress = lanes(scaled);
      EXPECT_EQ(flow(hardening)(stress, strain).any, more > 1);
    }
  }
}

TEST_P(BentFlowOf, LeavesWhatDoesNotYield)
{
  const Parts t{0.1 * limit, -0.3 * limit, 0.2 * limit, 0.3 * limit, 0.1 * limit};
  BentStress stress = lanes(t);
  EXPECT_FALSE(flow()(stress, 0.0).any);
  EXPECT_EQ(parts(stress), t);
}

INSTANTIATE_TEST_SUITE_P(Planes, BentFlowOf,
                         ::testing::Values(PlaneAssumption::strain, PlaneAssumption::stress),
                         [](const auto& info) {
                           return info.param == PlaneAssumption::strain ? "Strain" : "Stress";
                         });

// In space.

using Matrix = Eigen::Matrix3d;

struct Brick {
  Matrix deviator, deformation;
  std::array<double, 12> bending;
};

/// One step of flow of `brick`.
BentReturn flow_of(Brick& brick)
{
  const BrickFlow flow(elastic, {limit, 0});
  alignas(lane_alignment) double columns[bending_columns<3> * lane_count];
  for (int k = 0; k < 12; ++k)
    store(Lanes(brick.bending[std::size_t(k)]), columns + k * lane_count);
  for (int k = 0; k < 9; ++k)
    store(Lanes(brick.deformation.data()[k]), columns + (12 + k) * lane_count);
  const Matrix& d = brick.deviator;
  Symmetric deviator{d(0, 0), d(1, 1), d(2, 2), d(0, 1), d(1, 2), d(0, 2)};
  const BentReturn result = flow(deviator, columns, 0.0);
  brick.deviator << deviator.xx[0], deviator.xy[0], deviator.xz[0], deviator.xy[0], deviator.yy[0],
      deviator.yz[0], deviator.xz[0], deviator.yz[0], deviator.zz[0];
  for (std::size_t k = 0; k < 12; ++k) brick.bending[k] -= columns[k * std::size_t(lane_count)];
  return result;
}

Brick scaled(Brick brick, double factor)
{
  brick.deviator *= factor;
  for (double& part : brick.bending) part *= factor;
  return brick;
}

/// What the stress can be multiplied with.
double bound(const Brick& brick)
{
  return largest_below(10, [&](double factor) {
    Brick tried = scaled(brick, factor);
    return flow_of(tried).any;
  });
}

class BrickFlowTest : public ::testing::Test {
 protected:
  Brick any(double size)
  {
    Brick brick;
    const Matrix a = size * Matrix::NullaryExpr([&] { return uniform_(random_); });
    brick.deviator = 0.5 * (a + a.transpose());
    brick.deviator.diagonal().array() -= brick.deviator.trace() / 3;
    for (double& part : brick.bending) part = 0.5 * size * uniform_(random_);
    brick.deformation =
        Matrix::Identity() + 0.3 * Matrix::NullaryExpr([&] { return uniform_(random_); });
    return brick;
  }
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST_F(BrickFlowTest, TurnsWithTheBrick)
{
  for (int trial = 0; trial < 50; ++trial) {
    Brick still = any(3 * limit), turned = still;
    const Matrix turn =
        Eigen::AngleAxisd(3 * uniform_(random_), Vec<3>::Random().normalized()).toRotationMatrix();
    turned.deviator = turn * still.deviator * turn.transpose();
    turned.deformation = turn * still.deformation;
    const double strain = flow_of(still).plastic_strain[0];
    EXPECT_NEAR(flow_of(turned).plastic_strain[0], strain, 1e-9 * strain + 1e-18);
    EXPECT_LT((turned.deviator - turn * still.deviator * turn.transpose()).norm(), 1e-9 * limit);
    for (std::size_t k = 0; k < 12; ++k)
      EXPECT_NEAR(turned.bending[k], still.bending[k], 1e-9 * limit);
  }
}

/// A plate along x and y that is drawn and bent in one way, whatever it is: m + n^2 = 1, and
/// m^2 + p^2 = 1 of what is not.
TEST_F(BrickFlowTest, OfAPlateIsThatOfASectionWhoseFibresYieldAllThrough)
{
  for (const double n : {0.0, 0.2, 0.5, 0.8}) {
    // Along x: stress s has the deviator s (2, -1, -1) / 3, and parts s / 2 and sqrt(3/4) s.
    const Vec<3> drawn(2.0 / 3, -1.0 / 3, -1.0 / 3);
    for (const double more : {0.999, 1 + 0.6 * rounded_vertex}) {
      Brick brick{more * n * limit * Matrix(drawn.asDiagonal()), Matrix::Identity(), {}};
      brick.bending[6] = more * (1 - n * n) * limit * 0.5;
      brick.bending[7] = more * (1 - n * n) * limit * std::sqrt(0.75);
      EXPECT_EQ(flow_of(brick).any, more > 1) << n;
      Brick sheared{Matrix::Zero(), Matrix::Identity(), brick.bending};
      sheared.deviator(0, 2) = sheared.deviator(2, 0) = more * n * limit / std::sqrt(3.0);
      sheared.bending = {};
      sheared.bending[6] = more * std::sqrt(1 - n * n) * limit * 0.5;
      sheared.bending[7] = more * std::sqrt(1 - n * n) * limit * std::sqrt(0.75);
      EXPECT_EQ(flow_of(sheared).any, more > 1) << n;
    }
  }
}

/// Where two walls that are held along z meet: as cells of the plane do, and in space as in the
/// plane whichever way either is bent.
TEST_F(BrickFlowTest, BearsTheMomentsOfPlatesThatCross)
{
  for (const double share : {0.0, 0.2, 0.5, 1.0})
    for (const double sign : {-1.0, 1.0})
      for (const double n : {0.0, 0.3, 0.7})
        for (const double more : {0.999, 1 + 0.7 * rounded_vertex}) {
          // Stress s along the fibres and s / 2 along z; in plane strain the centre is sheared.
          const double size = more * limit, moment = (1 - n * n) * size / std::sqrt(0.75);
          Brick brick{n * size / std::sqrt(3.0) * Matrix(Vec<3>(1, -1, 0).asDiagonal()),
                      Matrix::Identity(),
                      {}};
          const auto bend = [&](std::size_t first, double along_first, double along_second) {
            brick.bending[first] = 0.5 * (along_first + along_second);
            brick.bending[first + 1] = std::sqrt(0.75) * (along_first - along_second);
          };
          bend(0, share * moment, 0.5 * share * moment);                            // y, z
          bend(3, 0.5 * sign * (1 - share) * moment, sign * (1 - share) * moment);  // z, x
          EXPECT_EQ(flow_of(brick).any, more > 1) << share << " " << sign << " " << n;
        }
}

/// As far as fibres of all plates bear where they cross worst, with stress at the centre or
/// without.
TEST_F(BrickFlowTest, OfSeveralPlatesIsThatOfTheirWorstCrossing)
{
  const auto deviator_of = [](const Brick& brick, int j) {
    // Along the next two axes: half of the sum of both stresses, and so on (bending.hpp).
    const double* part = &brick.bending[3 * std::size_t(j)];
    const double sum = 2 * part[0], difference = part[1] / std::sqrt(0.75);
    const int next = (j + 1) % 3, last = (j + 2) % 3;
    Matrix stress = Matrix::Zero();
    stress(next, next) = 0.5 * (sum + difference);
    stress(last, last) = 0.5 * (sum - difference);
    stress(next, last) = stress(last, next) = part[2] / std::sqrt(3.0);
    return Matrix(stress - stress.trace() / 3 * Matrix::Identity());
  };
  for (int trial = 0; trial < 300; ++trial) {
    Brick brick = any(limit);
    brick.deformation = Matrix::Identity();
    if (trial % 3 == 0) brick.deviator.setZero();
    if (trial % 3 == 1)  // one plate alone, or nearly
      for (std::size_t k = 3; k < 9; ++k) brick.bending[k] *= 1e-3 * (trial % 2);
    double warping = 0, worst = 0;
    for (std::size_t k = 9; k < 12; ++k) warping += brick.bending[k] * brick.bending[k];
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) {
        const Matrix t =
            deviator_of(brick, 0) + y * deviator_of(brick, 1) + z * deviator_of(brick, 2);
        const double half = 0.5 * (1.5 * t.squaredNorm() + warping),
                     product = 1.5 * t.cwiseProduct(brick.deviator).sum();
        worst = std::max(worst, half + std::hypot(half, product));
      }
    const double bears = limit / std::sqrt(1.5 * brick.deviator.squaredNorm() + worst);
    const double ratio = bound(brick) / bears;
    EXPECT_GT(ratio, 1 - 1e-6) << trial;
    EXPECT_LT(ratio, 1 + 1.1 * rounded_vertex) << trial;
  }
}

/// (t - t*) C^-1 (t_trial - t) >= 0 for every stress t* that is allowed, with the moduli of
/// bending.hpp.
TEST_F(BrickFlowTest, DissipatesTheMost)
{
  const double shear = 3 * elastic.shear_modulus();
  const BendingModuli<3> moduli(elastic);
  const auto modulus = [&](std::size_t k) {
    return k >= 9       ? moduli.fibres * 16 / 9
           : k % 3 == 0 ? moduli.alike * 2 / 3
                        : moduli.opposite * 2;
  };
  for (int trial = 0; trial < 60; ++trial) {
    Brick trial_stress = any(limit);
    trial_stress = scaled(trial_stress, bound(trial_stress));
    trial_stress.deformation = Matrix::Identity();
    const Brick step = any(1e-4 * limit);
    trial_stress.deviator += step.deviator;
    for (std::size_t k = 0; k < 12; ++k) trial_stress.bending[k] += step.bending[k];
    Brick now = trial_stress;
    if (!flow_of(now).any) continue;
    for (int other = 0; other < 60; ++other) {
      Brick allowed = any(limit);
      allowed.deformation = Matrix::Identity();
      allowed = scaled(allowed, bound(allowed));
      const Matrix lost = trial_stress.deviator - now.deviator;
      double work = 1.5 / shear * (now.deviator - allowed.deviator).cwiseProduct(lost).sum(),
             size = std::sqrt(1.5) / shear * lost.norm();
      for (std::size_t k = 0; k < 12; ++k) {
        const double flowed = (trial_stress.bending[k] - now.bending[k]) / modulus(k);
        work += (now.bending[k] - allowed.bending[k]) * flowed;
        size += std::abs(flowed);
      }
      EXPECT_GT(work, -1e-6 * limit * size) << trial << " " << other;
    }
  }
}

TEST_F(BrickFlowTest, EndsOnTheYieldSurface)
{
  for (int trial = 0; trial < 100; ++trial) {
    Brick brick = any(3 * limit);
    if (!flow_of(brick).any) continue;
    Brick again = brick;
    EXPECT_LT(flow_of(again).plastic_strain[0], 1e-6);
    EXPECT_LT((again.deviator - brick.deviator).norm(), 1e-6 * limit);
  }
}

/// A rotation that is not quite one turns a deviator into more or less, with a pressure, each time.
TEST_F(BrickFlowTest, StaysThereStepByStepHoweverMuchABrickIsSquashed)
{
  for (const double squashed : {0.33, 0.2, 0.12}) {
    Brick brick = any(3 * limit);
    const double wide = 1 / std::sqrt(squashed);
    brick.deformation = Eigen::AngleAxisd(0.7, Vec<3>(1, 2, 3).normalized()).toRotationMatrix() *
                        Vec<3>(wide, wide, squashed).asDiagonal();
    ASSERT_TRUE(flow_of(brick).any);
    const Matrix deviator = brick.deviator;
    double strain = 0;
    for (int step = 0; step < 1000; ++step) strain += flow_of(brick).plastic_strain[0];
    EXPECT_LT(std::abs(brick.deviator.trace()), 1e-9 * limit) << squashed;
    EXPECT_LT((brick.deviator - deviator).norm(), 1e-5 * limit) << squashed;
    EXPECT_LT(strain, 1e-6) << squashed;
  }
}

}  // namespace
}  // namespace mpm
