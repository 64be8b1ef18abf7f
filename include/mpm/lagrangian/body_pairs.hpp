#pragma once
/// What bodies of a total Lagrangian step do where they meet.

#include <cstddef>
#include <vector>

namespace mpm {

/// Bodies are one mesh and stick where they were neighbours at rest, and cells that come to meet
/// slide on each other, but for what a pair says.
class BodyPairs {
 public:
  explicit BodyPairs(int bodies = 0)
      : bodies_(bodies), apart_(square(), 0), friction_(square(), 0.0)
  {
  }
  /// Two bodies have nodes of their own, and Coulomb's coefficient between them; one with itself
  /// has the coefficient alone.
  void add(int first, int second, double friction)
  {
    for (const std::size_t at : {index(first, second), index(second, first)}) {
      apart_[at] = first != second;
      friction_[at] = friction;
    }
    any_ = true;
    any_apart_ = any_apart_ || first != second;
    any_friction_ = any_friction_ || friction > 0;
  }
  bool are_apart(int a, int b) const { return any_apart_ && apart_[index(a, b)]; }
  double friction(int a, int b) const { return friction_[index(a, b)]; }
  bool any() const { return any_; }
  bool any_apart() const { return any_apart_; }
  bool any_friction() const { return any_friction_; }

  /// A body's own, where any are apart.
  unsigned bit_of(int body) const { return any_apart_ ? 1u << body : 1u; }
  /// Of the cells around a corner, a bit for each body that has one: the bodies that have one node
  /// there with the body of that bit: those that stick to it, and to each other, in turn.
  unsigned joined(unsigned around, unsigned body) const
  {
    if (!any_apart_) return around;
    unsigned joined = body;
    for (unsigned before = 0; before != joined;) {
      before = joined;
      for (int a = 0; a < bodies_; ++a)
        for (int b = 0; b < bodies_; ++b)
          if (joined >> a & 1u && around >> b & 1u && !are_apart(a, b)) joined |= 1u << b;
    }
    return joined;
  }

 private:
  std::size_t square() const { return std::size_t(bodies_) * std::size_t(bodies_); }
  std::size_t index(int a, int b) const { return std::size_t(a * bodies_ + b); }

  int bodies_;
  std::vector<char> apart_;
  std::vector<double> friction_;
  bool any_ = false, any_apart_ = false, any_friction_ = false;
};

}  // namespace mpm
