#pragma once
#include <mpm/conditions/contact.hpp>
#include <mpm/conditions/surface_place.hpp>
#include <mpm/transfer/scheme.hpp>

#include <optional>
#include <vector>

namespace mpm {

/// Coulomb friction between bodies that move in velocity fields of their own (Bardenhagen,
/// Brackbill & Sulsky 2000, CMAME 187:529): at a node that two of them reach, an impulse takes what
/// would close their gap within the step and more, and holds them along the surface as far as
/// friction can. Fields that nothing is said about stick to each other.
template <int Dim>
class BodyContact final : public Contact<Dim> {
 public:
  struct Pair {
    int first, second;  ///< fields
    double friction;    ///< tangential over normal force, at most
  };

  BodyContact(int fields, const std::vector<Pair>& pairs, SurfacePlace place, ReactionBook book);

  bool needs_surfaces() const override { return true; }
  std::span<const char> meet(const GridTopology<Dim>& grid, int support,
                             std::span<NodeFields<Dim>> fields) override;
  void measure(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields) override;
  void exchange_momentum(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields,
                         double time, double dt) override;
  void exchange_gradient(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields,
                         double time, double dt) override;
  void book(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields) override;
  Reaction<Dim> take_reaction() override { return reaction_.take(); }
  std::optional<ContactSums> sums() const override;
  void archive(Archive& archive) override;

 private:
  /// Two fields at a node.
  struct Meeting {
    LocalIndex node;
    int first, second;
    std::optional<double> friction;       ///< none: they stick
    Vec<Dim> normal = Vec<Dim>::Zero();   ///< from the first to the second
    double gap = 0;                       ///< m
    Vec<Dim> impulse = Vec<Dim>::Zero();  ///< N s, in this step, on the particles of the first
    bool closed = false, stuck = false;
  };

  const std::optional<double>& friction_of(int first, int second) const
  {
    return friction_[std::size_t(first * fields_ + second)];
  }
  /// m/s, at which a gap may close; any in no time.
  static double allowed_in(const Meeting& meeting, double dt)
  {
    return meeting.gap > 0 ? meeting.gap / dt : 0.0;
  }
  template <class Exchange>
  void for_each_exchange(std::span<NodeFields<Dim>> fields, Exchange exchange);

  int fields_;
  std::vector<std::optional<double>> friction_;  ///< by both fields
  SurfacePlace place_;
  ReactionBook book_;
  std::vector<Meeting> meetings_;  ///< by node
  std::vector<char> asked_;        ///< first nodes of stencils that reach one of them
  Reaction<Dim> reaction_;
  double friction_work_ = 0;  ///< J, since the start
  GlobalIndex touching_ = 0;  ///< in the last step
};

}  // namespace mpm
