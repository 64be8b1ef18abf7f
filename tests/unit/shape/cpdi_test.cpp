// CPDI weights of domains of any form, in the plane and in space.
#include <mpm/shape/cpdi.hpp>
#include <mpm/shape/gimp.hpp>

#include <Eigen/LU>
#include <random>

#include "sampled_shape.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

/// In cells; nodes at whole numbers from the first one on.
template <int Dim>
struct Weights {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  static constexpr int nodes = Cpdi::nodes<Dim>;
  alignas(lane_alignment) double weight[nodes][lane_count], gradient[Dim][nodes][lane_count];
  Matrix seen;  ///< half axes as the weights see them

  Weights(const Vector& place, const Matrix& domain)
  {
    Lanes r[Dim], axes[Dim * Dim];
    double scale[Dim];
    for (int d = 0; d < Dim; ++d) {
      r[d] = place[d];
      scale[d] = 1;
      for (int k = 0; k < Dim; ++k) axes[d + Dim * k] = domain(d, k);
    }
    const Cpdi shape = Cpdi::make(0.5);
    shape.limit<Dim>(axes);
    for (int k = 0; k < Dim * Dim; ++k) seen(k % Dim, k / Dim) = axes[k][lane_count - 1];
    shape.weights<Dim>(r, axes, scale, weight, gradient);
  }
  static Vector place_of(int node)
  {
    Vector x;
    for (int d = 0; d < Dim; ++d, node /= 4) x[d] = node % 4;
    return x;
  }
  double w(int node) const { return weight[node][lane_count - 1]; }
  Vector g(int node) const
  {
    Vector slope;
    for (int d = 0; d < Dim; ++d) slope[d] = gradient[d][node][lane_count - 1];
    return slope;
  }
};

/// Weights up to 1, gradients up to 1 over the smallest extent of a domain, 1e-2.
constexpr double rounding = 1e-13;

template <int Dim>
void expect_linear_fields_exactly()
{
  using Vector = typename Weights<Dim>::Vector;
  using Matrix = typename Weights<Dim>::Matrix;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  int limited = 0;
  for (int k = 0; k < 300; ++k) {
    const auto any = [&] { return number(random); };
    const Vector place = Vector::NullaryExpr([&] { return 1.5 + 0.5 * any(); });
    Matrix domain = (k % 3 == 0 ? 2.0 : 0.3) * Matrix::NullaryExpr(any);
    if (domain.determinant() < 0) domain.col(0) *= -1;
    if (domain.determinant() < 1e-2 * std::pow(domain.norm(), Dim)) continue;
    const Weights<Dim> s(place, domain);
    limited += (s.seen - domain).norm() > 0.1;
    double sum = 0;
    Vector value = Vector::Zero(), slopes = Vector::Zero();
    Matrix slope = Matrix::Zero();
    for (int node = 0; node < s.nodes; ++node) {
      const Vector x = s.place_of(node);
      EXPECT_GE(s.w(node), 0);
      sum += s.w(node);
      value += s.w(node) * x;
      slopes += s.g(node);
      slope += x * s.g(node).transpose();
    }
    ASSERT_NEAR(sum, 1, rounding);
    ASSERT_LT((value - place).norm(), rounding);
    ASSERT_LT(slopes.norm(), 100 * rounding);
    ASSERT_LT((slope - Matrix::Identity()).norm(), 100 * rounding);
  }
  EXPECT_GT(limited, 20);
}

TEST(CpdiShape, ReproducesConstantAndLinearFieldsOnAnyDomain)
{
  expect_linear_fields_exactly<2>();
  expect_linear_fields_exactly<3>();
}

TEST(CpdiShape, HasTheCornerMeansOfAShearedDomainWorkedOutByHand)
{
  // r_1 = (0.5, 0), r_2 = (0.25, 0.25) around (1.5, 1.5): corners (0.75, 1.25), (1.75, 1.25),
  // (1.25, 1.75), (2.25, 1.75); area 4 x 0.125.
  const Weights<2> s({1.5, 1.5}, (Eigen::Matrix2d() << 0.5, 0.25, 0, 0.25).finished());
  const auto at = [](int x, int y) { return x + 4 * y; };
  EXPECT_NEAR(s.w(at(0, 1)), 0.25 * 0.25 * 0.75, rounding);
  EXPECT_NEAR(s.w(at(1, 1)), 0.25 * (0.75 * 0.75 + 0.25 * 0.75 + 0.75 * 0.25), rounding);
  EXPECT_NEAR(s.w(at(3, 2)), 0.25 * 0.25 * 0.75, rounding);
  EXPECT_EQ(s.w(at(3, 3)), 0);
  // R^-T = ((2, 0), (-2, 4)); node (0, 1) sees the corner (-, -) alone, with 3/16.
  EXPECT_NEAR(s.g(at(0, 1))[0], 0.25 * (3.0 / 16) * -2, rounding);
  EXPECT_NEAR(s.g(at(0, 1))[1], 0.25 * (3.0 / 16) * (2 - 4), rounding);
}

TEST(CpdiShape, GradientAtRestIsThatOfUniformGimpAlongALine)
{
  // Of functions of one coordinate: (N(x + l) - N(x - l)) / 2l for both.
  for (double x = 2; x < 5; x += 0.0137) {
    const auto cpdi = sample(Cpdi{0.25}, x);
    const auto gimp = sample(Gimp{0.25}, x);
    for (int node = 0; node < 8; ++node)
      ASSERT_NEAR(cpdi.gradient_of(node), gimp.gradient_of(node), 10 * rounding) << "x = " << x;
  }
}

TEST(CpdiShape, LongDomainsEndACellAwayAndKeepTheirWidth)
{
  const Weights<2> s({1.5, 1.5}, (Eigen::Matrix2d() << 3, 0, 0, 0.2).finished());
  EXPECT_LT((s.seen - (Eigen::Matrix2d() << 1, 0, 0, 0.2).finished()).norm(), rounding);
}

TEST(CpdiShape, FlatDomainsReachHalfAsFarAsAtRestAndKeepTheirLength)
{
  const Weights<2> s({1.5, 1.5}, (Eigen::Matrix2d() << 0.3, 0, 0, 0.01).finished());
  EXPECT_LT((s.seen - (Eigen::Matrix2d() << 0.3, 0, 0, 0.125).finished()).norm(), rounding);
}

TEST(CpdiShape, DomainsWithoutVolumeAreThoseOfParticlesAtRest)
{
  const Eigen::Matrix2d rest = 0.25 * Eigen::Matrix2d::Identity();
  const Weights<2> expected({1.2, 1.7}, rest);
  const Eigen::Matrix2d inverted = (Eigen::Matrix2d() << 0, 0.3, 0.3, 0).finished();
  const Eigen::Matrix2d line = (Eigen::Matrix2d() << 0.3, 0.6, 0.2, 0.4).finished();
  for (const Eigen::Matrix2d& domain : {Eigen::Matrix2d(Eigen::Matrix2d::Zero()), inverted, line}) {
    const Weights<2> s({1.2, 1.7}, domain);
    EXPECT_EQ(s.seen, rest);
    for (int node = 0; node < s.nodes; ++node) {
      EXPECT_EQ(s.w(node), expected.w(node));
      EXPECT_EQ(s.g(node), expected.g(node));
    }
  }
}

}  // namespace
}  // namespace mpm
