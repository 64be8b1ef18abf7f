#pragma once
/// Particles that leave this rank's cells in a step go to the neighbour that owns their new cell.

#include <mpm/parallel/decomposition.hpp>
#include <mpm/transfer/transfer.hpp>

#include <span>

namespace mpm {

/// In a step a particle gets no farther than the cells next to this rank's own, so its new owner is
/// a neighbour in the halo. Who leaves a periodic axis at one end enters it at the other. How much
/// each neighbour has to expect travels as a note with the halo's message: no message at all while
/// nobody leaves, no collective ever.
template <int Dim>
class Migration {
 public:
  /// `neighbours`: of the halo, which share this rank's surroundings.
  Migration(const Decomposition<Dim>& decomposition, int support, std::vector<int> neighbours);

  /// Packs the particles of a part that are in another rank's cell; bodies in ascending order.
  /// Those that crossed the end of a periodic axis are moved back by its period first.
  /// Returns a particle that is beyond all neighbouring cells, if there is one.
  std::optional<LocalIndex> collect(const BodyPart<Dim>& part, std::size_t body);
  /// Sends what was collected; `notes` are then what the neighbours have to expect.
  void send();
  std::span<const LocalIndex> notes() const { return notes_; }

  struct Outcome {
    GlobalIndex sent = 0;            ///< particles, by this rank
    std::vector<LocalIndex> stayed;  ///< per body; arrivals stand behind, in the order of ranks
  };
  /// Takes out what was sent and adds what the neighbours' notes say.
  Outcome finish(std::vector<Body<Dim>>& bodies, std::span<const LocalIndex> expected);

  GlobalIndex messages() const { return messages_; }
  GlobalIndex bytes() const { return bytes_; }

 private:
  /// For one neighbour: packed particles of each body.
  using Packet = std::vector<std::vector<double>>;
  void unpack(std::vector<Body<Dim>>& bodies, const std::vector<double>& buffer) const;

  static constexpr int beyond = -2, home = -1;
  MPI_Comm comm_;
  GridGeometry<Dim> geometry_;
  bool periodic_;  ///< any axis
  IndexBox<Dim> local_;
  std::vector<int> neighbours_;
  std::vector<int> target_;      ///< per cell of `local_`: home, place in `neighbours_`, or beyond
  std::vector<Packet> packets_;  ///< per neighbour
  std::vector<std::vector<LocalIndex>> gone_;  ///< per body
  bool moved_back_ = false;                    ///< any particle, since the last `finish`
  std::vector<std::vector<double>> buffers_;
  std::vector<LocalIndex> notes_;
  std::vector<MPI_Request> sends_;
  GlobalIndex messages_ = 0, bytes_ = 0;
};

}  // namespace mpm
