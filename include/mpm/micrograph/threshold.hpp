#pragma once
/// The gray level that separates cell wall from void.

#include <mpm/micrograph/share.hpp>
#include <mpm/scene/scene.hpp>

#include <cstdint>
#include <span>

namespace mpm::micrograph {

/// A location is cell wall if its mean reaches the threshold, where walls are bright, or stays
/// below it, where they are dark. The same threshold thus splits a picture into the same two parts.
constexpr bool is_wall(double mean, double threshold, scene::Wall wall)
{
  return wall == scene::Wall::bright ? mean >= threshold : mean < threshold;
}

/// N. Otsu, IEEE Trans. Syst. Man Cybern. 9 (1979) 62: the level that makes the variance between
/// the two classes greatest. It is a whole one where all pixels are, and a multiple of 1/257, the
/// levels of 16 bits, otherwise. The result t makes the classes `below t` and `t and above`; where
/// no pixel lies between the classes, the middle of the gap, rounded down. Throws InputError for an
/// image of one level.
double otsu_threshold(std::span<const double> gray);

/// The n-th smallest (n from 0) of the values that all parts hold together; none is negative.
/// Collective.
double nth_smallest(std::span<const double> values, std::int64_t n, const Share& share);

/// The level that has the nearest to `share_below` (0 to 1) of all parts' values below it; halfway
/// between the two values it separates. Collective.
double level_with_share_below(std::span<const double> values, double share_below,
                              const Share& share);

/// The threshold that makes the fraction of wall among the locations nearest to `target`.
/// Collective. Throws InputError unless 0 < target < 1.
double threshold_for_density(std::span<const double> means, double target, scene::Wall wall,
                             const Share& share);

}  // namespace mpm::micrograph
