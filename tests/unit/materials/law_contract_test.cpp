// What every law in the list must fulfil, by itself and for the step. A new law joins by its line
// in laws.list.
#include <cmath>
#include <random>

#include "listed_laws.hpp"

namespace mpm {
namespace {

class LawContract : public testing::TestWithParam<ListedLaw> {};
INSTANTIATE_TEST_SUITE_P(Listed, LawContract, testing::ValuesIn(listed_laws()),
                         [](const auto& info) { return info.param.name; });

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
Matrix<Dim> random_matrix(std::mt19937& random, double size)
{
  std::uniform_real_distribution component(-size, size);
  return Matrix<Dim>::NullaryExpr([&] { return component(random); });
}

template <int Dim>
Matrix<Dim> random_rotation(std::mt19937& random, double angle)
{
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  else
    return Eigen::AngleAxisd(angle, random_matrix<3>(random, 1).col(0).normalized())
        .toRotationMatrix();
}

template <int Dim>
Eigen::Matrix3d in_space(const Matrix<Dim>& m)
{
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  result.topLeftCorner<Dim, Dim>() = m;
  return result;
}

/// Stiffness of the fastest wave in the undeformed material, Pa.
template <int Dim>
double wave_modulus(const ListedLaw& listed)
{
  return listed.density() * std::pow(listed.make<Dim>()->wave_speed(), 2);
}

TEST_P(LawContract, HasADensityAndAsItsFirstColumnTheInitialVolume)
{
  EXPECT_TRUE(GetParam().row->has("density"));
  GetParam().in_its_dimension([&]<int Dim>() {
    const auto columns = GetParam().make<Dim>()->state_columns();
    EXPECT_EQ(columns.front().name, "initial_volume");
    EXPECT_EQ(columns.front().components, 1);
  });
}

TEST_P(LawContract, AFreshParticleIsFreeOfStressAndEnergyAndStaysSoAtRest)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    MaterialPoint<Dim> point(GetParam().make<Dim>());
    for (int step = 0; step < 3; ++step) {
      EXPECT_EQ(point.cauchy().norm(), 0);
      EXPECT_EQ(point.kirchhoff().norm(), 0);
      EXPECT_EQ(point.elastic_energy(), 0);
      EXPECT_EQ(point.dissipated(), 0);
      point.apply(Matrix<Dim>::Identity());
    }
  });
}

TEST_P(LawContract, AnyRotationTurnsTheStressAndKeepsTheEnergy)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    std::mt19937 random(2);
    const double rounding = 1e-12 * wave_modulus<Dim>(GetParam());
    MaterialPoint<Dim> point(GetParam().make<Dim>());
    point.apply(Matrix<Dim>::Identity() + random_matrix<Dim>(random, 0.04));
    const Eigen::Matrix3d before = point.cauchy();
    const double energy = point.elastic_energy(), plastic = point.dissipated();
    ASSERT_GT(before.norm(), 1e6 * rounding);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    for (int step = 0; step < 40; ++step) {
      const Matrix<Dim> r = random_rotation<Dim>(random, 0.9);
      point.apply(r);
      turn = in_space<Dim>(r) * turn;
      ASSERT_LT((point.cauchy() - turn * before * turn.transpose()).norm(), rounding)
          << "step " << step;
    }
    EXPECT_NEAR(point.elastic_energy(), energy, 1e-11 * energy);
    // A stress at the yield limit may pass it by a rounding.
    EXPECT_NEAR(point.dissipated(), plastic, 1e-10 * energy);
  });
}

TEST_P(LawContract, ForceIsVolumeTimesKirchhoffStressBothFromTheUpdateAndFromTheState)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    std::mt19937 random(3);
    MaterialPoint<Dim> point(GetParam().make<Dim>(), 7);
    const double rounding = 1e-12 * wave_modulus<Dim>(GetParam());
    for (int step = 0; step < 5; ++step) {
      point.apply(Matrix<Dim>::Identity() + random_matrix<Dim>(random, 0.03));
      EXPECT_LT((point.force() - 7 * point.kirchhoff()).norm(), 7 * rounding);
    }
    // tau = J sigma: in plane stress J holds the thickness, so that only the ratio is the same.
    const Matrix<Dim> cauchy = point.cauchy().template topLeftCorner<Dim, Dim>();
    const double ratio = point.kirchhoff().norm() / cauchy.norm();
    EXPECT_LT((point.kirchhoff() - ratio * cauchy).norm(), rounding);
    EXPECT_NEAR(point.volume_ratio(), ratio, 1e-11);
    if (Dim == 3 || GetParam().plane == PlaneAssumption::strain) {
      EXPECT_NEAR(ratio, point.deformation().determinant(), 1e-11);
    }
  });
}

/// What the stress did on a closed way through F, and what became of it.
template <int Dim>
struct Ledger {
  double work = 0, largest = 0, elastic = 0, dissipated = 0;
  double imbalance() const { return std::abs(work - elastic - dissipated); }
};
template <int Dim>
Ledger<Dim> closed_way(const ListedLaw& listed, int steps)
{
  std::mt19937 random(4);
  const Matrix<Dim> a = random_matrix<Dim>(random, 0.06), b = random_matrix<Dim>(random, 0.06);
  MaterialPoint<Dim> point(listed.make<Dim>());
  Ledger<Dim> ledger;
  for (int k = 1; k <= steps; ++k) {
    const double t = 2 * M_PI * k / steps;
    const Matrix<Dim> next =
        Matrix<Dim>::Identity() + std::sin(t) * a + (1 - std::cos(t)) * std::sin(t / 2) * b;
    const Matrix<Dim> f = next * point.deformation().inverse(), one = Matrix<Dim>::Identity();
    const Matrix<Dim> before = point.kirchhoff();
    point.apply(f);
    const Matrix<Dim> middle = (f - one) * (0.5 * (f + one)).inverse();
    ledger.work += 0.5 * ((before + point.kirchhoff()).transpose() * middle).trace();
    ledger.largest = std::max(ledger.largest, point.elastic_energy());
  }
  ledger.elastic = point.elastic_energy();
  ledger.dissipated = point.dissipated();
  return ledger;
}

TEST_P(LawContract, OnAClosedWayTheWorkIsWhatIsStoredAndDissipated)
{
  // Second order in the step without plastic flow, first with it; laws in a rate may keep a
  // residual stress, with its energy.
  GetParam().in_its_dimension([&]<int Dim>() {
    const Ledger<Dim> coarse = closed_way<Dim>(GetParam(), 400),
                      fine = closed_way<Dim>(GetParam(), 800);
    ASSERT_GT(fine.largest, 0);
    EXPECT_GE(fine.dissipated, 0);
    EXPECT_LT(fine.imbalance(), 4e-3 * (fine.largest + fine.dissipated));
    EXPECT_LT(fine.imbalance(), 0.6 * coarse.imbalance() + 1e-12 * fine.largest);
    if (fine.dissipated == 0) {
      EXPECT_LT(fine.elastic, 1e-3 * fine.largest);
    }
  });
}

/// Largest eigenvalue of the acoustic tensor over many directions n, divided by the density: a step
/// a (x) n changes the stress by dtau, and Q a = dtau n - tau n (a . n), rho_0 c^2 = eigenvalue.
template <int Dim>
double differenced_wave_squared(const MaterialPoint<Dim>& point, double density)
{
  constexpr double step = 1e-6;
  const auto stress_after = [&](const Matrix<Dim>& change) {
    MaterialPoint<Dim> moved = point;
    moved.apply(Matrix<Dim>::Identity() + change);
    return moved.kirchhoff();
  };
  using Vector = Eigen::Matrix<double, Dim, 1>;
  const Matrix<Dim> tau = point.kirchhoff();
  std::mt19937 random(5);
  double largest = 0;
  for (int k = 0; k < 300; ++k) {
    const Vector n = random_matrix<Dim>(random, 1).col(0).normalized();
    Matrix<Dim> acoustic;
    for (int d = 0; d < Dim; ++d) {
      const Vector a = Vector::Unit(d);
      const Matrix<Dim> change = step * a * n.transpose();
      acoustic.col(d) =
          (stress_after(change) - stress_after(-change)) / (2 * step) * n - tau * n * a.dot(n);
    }
    // Of dynamic size, Eigen's solver is compiled once for both dimensions.
    largest = std::max(largest, Eigen::MatrixXd(acoustic).eigenvalues().real().maxCoeff());
  }
  return largest / density;
}

TEST_P(LawContract, TheUndeformedFastestWaveIsThatOfTheAcousticTensor)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    const MaterialPoint<Dim> point(GetParam().make<Dim>());
    const double speed = point.law().wave_speed();
    // Directions are random: the best of 300 is within 2 degrees or so.
    const double found = std::sqrt(differenced_wave_squared(point, GetParam().density()));
    EXPECT_LT(found, speed * (1 + 1e-6));
    EXPECT_GT(found, speed * (1 - 5e-3));
    EXPECT_NEAR(point.fastest_wave(), speed, 1e-12 * speed);
  });
}

TEST_P(LawContract, TheFastestWaveOfStretchedStatesIsNotBelowThatOfTheAcousticTensorNorFarAbove)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    std::mt19937 random(6);
    for (int k = 0; k < 12; ++k) {
      const Matrix<Dim> q = random_rotation<Dim>(random, 0.7 * k);
      Matrix<Dim> stretch = Matrix<Dim>::Zero();
      std::uniform_real_distribution logarithm(-0.6, 0.3);
      for (int d = 0; d < Dim; ++d) stretch(d, d) = std::exp(logarithm(random));
      MaterialPoint<Dim> point(GetParam().make<Dim>());
      point.go_to(q * stretch * q.transpose(), 200);
      const double found = std::sqrt(differenced_wave_squared(point, GetParam().density()));
      const double stated = point.fastest_wave();
      EXPECT_GE(stated, found * (1 - 1e-3)) << "state " << k;
      EXPECT_LE(stated, std::max(found, point.law().wave_speed()) * 1.3) << "state " << k;
    }
  });
}

/// Rubber that is drawn along all axes, where the fastest wave is a transverse one.
TEST_P(LawContract, TheFastestWaveOfStatesDrawnFarIsNotBelowThatOfTheAcousticTensor)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    for (const double logarithm : {0.6, 1.2, 1.8}) {
      MaterialPoint<Dim> point(GetParam().make<Dim>());
      Matrix<Dim> drawn = std::exp(logarithm) * Matrix<Dim>::Identity();
      drawn(0, 0) *= 1.1;
      point.go_to(drawn, 400);
      const double found = std::sqrt(differenced_wave_squared(point, GetParam().density()));
      EXPECT_GE(point.fastest_wave(), found * (1 - 1e-3)) << logarithm;
    }
  });
}

TEST_P(LawContract, PaddingGivesNoForceAndNoEnergyAndEveryLaneIsAParticleOfItsOwn)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    const auto law = GetParam().make<Dim>();
    constexpr int width = symmetric_components<Dim>, count = lane_count + 1;
    ParticleStore particles({{"position", Dim, "m"}}, law->state_columns(),
                            {"initial_volume", "plastic_work"});
    for (int p = 0; p < count; ++p) {
      particles.add(p);
      law->initialise(particles.state(), p);
      particles.state()(0, p) = 1 + p;
    }
    particles.seal();
    constexpr double dt = 1.0 / 1024;
    std::mt19937 random(7);
    std::vector<Matrix<Dim>> changes;
    for (int p = 0; p < 2 * lane_count; ++p) changes.push_back(random_matrix<Dim>(random, 0.08));
    LaneVector<double> gradient(2 * Dim * Dim * lane_count), force(2 * width * lane_count);
    for (int p = 0; p < 2 * lane_count; ++p)
      for (int k = 0; k < Dim * Dim; ++k)
        gradient[((p / lane_count) * Dim * Dim + k) * lane_count + p % lane_count] =
            changes[p](k % Dim, k / Dim) / dt;
    law->update(particles.state().block(0), 2, gradient.data(), dt, force.data());
    const double rounding = 1e-12 * wave_modulus<Dim>(GetParam());
    for (int p = 0; p < count; ++p) {
      MaterialPoint<Dim> alone(law, 1 + p);
      alone.apply(Matrix<Dim>::Identity() + changes[p]);
      EXPECT_NEAR(force[(p / lane_count) * width * lane_count + p % lane_count],
                  alone.force()(0, 0), rounding * (1 + p))
          << "particle " << p;
    }
    const Lanes energy = law->elastic_energy(particles.state().block(1));
    EXPECT_GT(energy[0], 0);
    for (int lane = 1; lane < lane_count; ++lane) {
      EXPECT_EQ(energy[lane], 0);
      for (int k = 0; k < width; ++k) EXPECT_EQ(force[(width + k) * lane_count + lane], 0);
    }
  });
}

TEST_P(LawContract, AVelocityThatIsNoNumberShowsInForceAndStress)
{
  GetParam().in_its_dimension([&]<int Dim>() {
    MaterialPoint<Dim> point(GetParam().make<Dim>());
    Matrix<Dim> f = Matrix<Dim>::Identity();
    f(0, Dim - 1) = std::nan("");
    point.apply(f);
    EXPECT_TRUE(point.force().hasNaN());
    EXPECT_TRUE(point.cauchy().hasNaN());
  });
}

}  // namespace
}  // namespace mpm
