#include <mpm/core/lanes.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

namespace mpm {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Largest of |ours - standard| / |standard| over many lanes filled by `draw`.
template <class Draw, class Ours, class Standard>
double largest_relative_error(Draw draw, Ours ours, Standard standard)
{
  double largest = 0;
  for (int k = 0; k < 100000 / lane_count; ++k) {
    const Lanes x([&](auto) { return draw(); });
    const Lanes y = ours(x);
    for (int lane = 0; lane < lane_count; ++lane) {
      const double exact = standard(x[lane]);
      largest = std::max(largest, std::abs(y[lane] - exact) / std::abs(exact));
    }
  }
  return largest;
}

const auto our_log = [](const Lanes& x) { return lane_log(x); };
const auto our_exp = [](const Lanes& x) { return lane_exp(x); };
const auto standard_log = [](double x) { return std::log(x); };
const auto standard_exp = [](double x) { return std::exp(x); };

// The tolerances are 4 epsilon: about ten roundings, of which the standard function has none.

TEST(LaneLog, AgreesWithTheStandardLogarithmOverAllNormalNumbers)
{
  std::mt19937 random(1);
  std::uniform_real_distribution exponent(-1022.0, 1023.9);
  EXPECT_LT(
      largest_relative_error([&] { return std::exp2(exponent(random)); }, our_log, standard_log),
      4 * epsilon);
}

TEST(LaneLog, KeepsItsRelativeAccuracyNearOneWhereTheLogarithmVanishes)
{
  std::mt19937 random(2);
  std::uniform_real_distribution exponent(-15.0, -0.4);
  std::bernoulli_distribution below(0.5);
  const auto draw = [&] {
    const double distance = std::pow(10.0, exponent(random));
    return below(random) ? 1 - distance : 1 + distance;
  };
  EXPECT_LT(largest_relative_error(draw, our_log, standard_log), 4 * epsilon);
}

TEST(LaneLog, OfOneIsZeroToTheLastBit)
{
  EXPECT_TRUE(stdx::all_of(lane_log(Lanes(1.0)) == 0.0));
}

TEST(LaneLog, OfPowersOfTwoAreMultiplesOfItsFirst)
{
  for (int k = -1000; k <= 1000; k += 8)
    EXPECT_EQ(lane_log(Lanes(std::exp2(k)))[0], k * std::log(2.0)) << "2^" << k;
}

TEST(LaneExp, AgreesWithTheStandardExponentialOverItsWholeRange)
{
  std::mt19937 random(3);
  std::uniform_real_distribution x(-700.0, 700.0);
  EXPECT_LT(largest_relative_error([&] { return x(random); }, our_exp, standard_exp), 4 * epsilon);
}

TEST(LaneExp, AgreesWithTheStandardExponentialForStrains)
{
  std::mt19937 random(4);
  std::uniform_real_distribution exponent(-16.0, 0.5);
  std::bernoulli_distribution negative(0.5);
  const auto draw = [&] {
    const double size = std::pow(10.0, exponent(random));
    return negative(random) ? -size : size;
  };
  EXPECT_LT(largest_relative_error(draw, our_exp, standard_exp), 4 * epsilon);
}

TEST(LaneExp, OfZeroIsOneToTheLastBit)
{
  EXPECT_TRUE(stdx::all_of(lane_exp(Lanes(0.0)) == 1.0));
}

TEST(LaneExp, UndoesTheLogarithmOfStretches)
{
  // d exp(y) = exp(y) dy, and |ln| < 3 here: 3 roundings of the logarithm and those of exp.
  std::mt19937 random(5);
  std::uniform_real_distribution stretch(0.05, 20.0);
  EXPECT_LT(largest_relative_error([&] { return stretch(random); },
                                   [](const Lanes& x) { return lane_exp(lane_log(x)); },
                                   [](double x) { return x; }),
            8 * epsilon);
}

TEST(Select, TakesEachLaneFromItsOwnSide)
{
  const Lanes number([](auto lane) { return double(lane); });
  const Lanes chosen = select(number >= 1.0, 10.0 + number, -number);
  for (int lane = 0; lane < lane_count; ++lane)
    EXPECT_EQ(chosen[lane], lane >= 1 ? 10.0 + lane : -double(lane)) << "lane " << lane;
}

TEST(LoadAndStore, KeepTheOrderOfTheLanes)
{
  alignas(lane_alignment) std::array<double, lane_count> column, copy{};
  for (int lane = 0; lane < lane_count; ++lane) column[lane] = 1.5 * lane - 2;
  store(load(column.data()), copy.data());
  EXPECT_EQ(copy, column);
}

}  // namespace
}  // namespace mpm
