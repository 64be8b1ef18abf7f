#pragma once
/// Sums of node values over the ranks that share the nodes.

#include <mpm/parallel/decomposition.hpp>

#include <memory>

namespace mpm {

/// Every rank whose stencils reach a node holds a partial sum there. One round of messages gives
/// each sharer all partial sums, and each adds them in the order of the ranks: the same bits on
/// all of them, and no second round to copy results back. Only shared nodes are packed; there is
/// one message per neighbour, through a PetscSF.
template <int Dim>
class Halo {
 public:
  /// Collective.
  Halo(const Decomposition<Dim>& decomposition, int support);
  ~Halo();
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;

  /// Shared nodes of this rank, local numbering, ascending.
  const std::vector<LocalIndex>& shared_nodes() const { return shared_; }

  // Each is collective over the neighbours.
  void sum_mass_momentum_force(NodeGrid<Dim>& grid);  ///< MUSL, USL
  void sum_mass_momentum(NodeGrid<Dim>& grid);        ///< USF
  void sum_force(NodeGrid<Dim>& grid);                ///< USF
  void sum_remapped_momentum(NodeGrid<Dim>& grid);    ///< MUSL

  struct Traffic {
    int neighbours;
    GlobalIndex shared_nodes;
    GlobalIndex received_nodes;
  };
  Traffic traffic() const;

 private:
  class Exchange;
  /// `Count::value` doubles per node; place(node, v) points to value v of a node.
  template <class Count, class Place>
  void sum(Count count, Place place);

  /// Nodes shared with one rank: positions in `shared_`.
  struct Sharer {
    int rank;
    std::vector<LocalIndex> positions;
    std::size_t first;  ///< of its values in the receive buffer, in nodes
  };
  int rank_;
  std::vector<LocalIndex> shared_;
  std::vector<Sharer> sharers_;  ///< ascending rank
  std::size_t received_ = 0;
  std::unique_ptr<Exchange> exchange_;
};

}  // namespace mpm
