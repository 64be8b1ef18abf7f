#pragma once
/// Sums of node values over the ranks that share the nodes.

#include <mpm/grid/node_fields.hpp>
#include <mpm/parallel/decomposition.hpp>
#include <mpm/parallel/shared_nodes.hpp>

#include <span>

namespace mpm {

/// Every rank whose stencils reach a node holds a partial sum there. One round of messages gives
/// each sharer all partial sums, and each adds them in the order of the ranks: the same bits on
/// all of them, and no second round to copy results back. Only shared nodes are packed; there is
/// one message per neighbour, and work on other nodes may go on between `begin` and `end`.
///
/// What the values mean is the caller's business: any columns over the local nodes can be summed.
class Halo {
 public:
  Halo(MPI_Comm comm, SharedNodes shared);
  /// Of this rank's part.
  template <int Dim>
  Halo(const Decomposition<Dim>& decomposition, int support)
      : Halo(decomposition.comm(),
             find_shared_nodes(decomposition.ownership(), support, decomposition.rank()))
  {
  }

  /// Shared nodes of this rank, local numbering, ascending.
  const std::vector<LocalIndex>& shared_nodes() const { return shared_.nodes; }
  /// Other ranks that share nodes with this one, ascending.
  std::vector<int> neighbours() const;

  /// Sends this rank's partial sums in these columns, which stay where they are until `end`.
  /// `notes`: a number for each neighbour that travels along (none given: 0). Every neighbour calls
  /// the same.
  void begin(std::span<const NodeColumn> columns, std::span<const LocalIndex> notes = {});
  /// Lets messages move on during long work: large ones need both sides' attention.
  void advance();
  /// Waits for the others' partial sums and adds all.
  void end();
  /// Both at once.
  void sum(std::span<const NodeColumn> columns)
  {
    begin(columns);
    end();
  }
  /// What the neighbours noted in the last exchange.
  std::span<const LocalIndex> notes() const { return notes_; }
  /// Whether shared nodes still hold what `begin` sent.
  bool untouched() const;

  struct Traffic {
    GlobalIndex messages = 0, bytes = 0;  ///< sent by this rank since the start
    double waiting_seconds = 0;           ///< in `end`
  };
  const Traffic& traffic() const { return traffic_; }
  /// Pairs of a shared node and a neighbour.
  GlobalIndex sent_nodes() const { return shared_.sent_nodes(); }

 private:
  void read(LocalIndex node, double* to) const;
  void write(LocalIndex node, const double* from) const;

  MPI_Comm comm_;
  int rank_;
  SharedNodes shared_;
  std::vector<NodeColumn> columns_;
  std::size_t width_ = 0;  ///< values per node of all columns
  std::vector<double> own_, total_;
  std::vector<std::vector<double>> sent_, received_;  ///< per neighbour; the last one is the note
  std::vector<MPI_Request> requests_;
  std::vector<LocalIndex> notes_;
  Traffic traffic_;
};

}  // namespace mpm
