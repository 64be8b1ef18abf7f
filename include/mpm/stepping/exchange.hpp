#pragma once
/// Brings the ranks together within a step: the order of the particles, passes over them, sums at
/// shared nodes, migration.

#include <mpm/core/archive.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/migration.hpp>
#include <mpm/stepping/loss.hpp>
#include <mpm/transfer/transfer.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// In every pass the particles near other ranks come first, and those near walls at which shape
/// functions end; the rest are done while the sums on shared nodes, and the particles that leave,
/// are under way.
template <int Dim>
class Exchange {
 public:
  /// The transfer outlives this.
  Exchange(Decomposition<Dim> decomposition, const Transfer<Dim>& transfer);

  const Decomposition<Dim>& decomposition() const { return decomposition_; }
  const GridTopology<Dim>& topology() const { return topology_; }
  Halo& halo() { return halo_; }

  using Pass = std::function<PassOutcome<Dim>(const BodyPart<Dim>&)>;
  using MovingPass =
      std::function<PassOutcome<Dim>(const BodyPart<Dim>&, const MoveBounds<Dim>& bounds)>;
  /// A pass over all particles that adds to nodes, and the sum of these columns over the ranks.
  void pass_and_sum(std::vector<Body<Dim>>& bodies, std::span<const NodeColumn> columns,
                    const Moment& moment, const Pass& pass);
  /// The same for a pass that moves them; those that left go to their owner.
  void move_and_sum(std::vector<Body<Dim>>& bodies, std::span<const NodeColumn> columns,
                    const Moment& moment, double dt, const MovingPass& pass);
  /// Whether particles may have come near the end of what the last sort marked.
  bool sort_is_due() const;
  /// Particles in the order of their nodes; active nodes. What left activity must be cleared.
  std::vector<LocalIndex> sort(std::vector<Body<Dim>>& bodies);

  /// After one this rank does no more passes until all ranks stop.
  const std::optional<Loss<Dim>>& loss() const { return loss_; }
  /// Unless there is one already.
  void note_loss(const Body<Dim>& body, const LostParticle<Dim>& lost, const Moment& moment);

  double largest_speed() const { return largest_speed_; }  ///< m/s, in the last move
  GlobalIndex migrated() const { return migrated_; }
  GlobalIndex messages() const { return halo_.traffic().messages + migration_.messages(); }
  GlobalIndex bytes_sent() const { return halo_.traffic().bytes + migration_.bytes(); }
  double waiting_seconds() const { return halo_.traffic().waiting_seconds; }

  /// All but the counts. Throws InputError, loading, on another part of the grid.
  void archive(Archive& archive);

 private:
  /// Blocks of a body: [0, near_end) may touch shared nodes or walls, [near_end, rest) do not, and
  /// from `rest` on stand arrivals since the last sort.
  struct Order {
    LocalIndex near_end = 0, rest = 0;
  };

  using Bodies = std::vector<Body<Dim>>;
  using PartVisit = std::function<void(const BodyPart<Dim>&, std::size_t body)>;
  void visit_near(Bodies& bodies, const PartVisit& visit);
  /// With a look after the messages from time to time.
  void visit_interior(Bodies& bodies, const PartVisit& visit);
  void note_far_moves(const Bodies& bodies, const Moment& moment, double dt);
  void collect_leavers(Bodies& bodies, const Moment& moment);
  void exchange_leavers(Bodies& bodies);
  void mark_near_walls();
  void sort_body(std::size_t number, ParticleStore& particles);
  void archive_part(Archive& archive) const;
  void archive_loss(Archive& archive);

  Decomposition<Dim> decomposition_;
  const Transfer<Dim>& transfer_;
  GridTopology<Dim> topology_;
  Halo halo_;
  Migration<Dim> migration_;
  MoveBounds<Dim> bounds_;
  /// Stencils with this first node may come to touch shared nodes, or walls at which they end.
  std::vector<char> near_;

  std::optional<Loss<Dim>> loss_;
  GlobalIndex migrated_ = 0;
  double largest_speed_ = 0;
  double moved_since_sort_ = 0, moved_last_ = 0;  ///< m, bounds on any particle's motion
  int moves_since_sort_ = 0;
  std::vector<Order> orders_;
  std::vector<LocalIndex> first_nodes_, order_, counts_;
};

}  // namespace mpm
