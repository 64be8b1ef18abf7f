#pragma once
/// Copies of other ranks' items, brought up to date by one message to each rank that holds some.

#include <mpm/core/types.hpp>
#include <mpm/parallel/session.hpp>

#include <functional>
#include <span>
#include <vector>

namespace mpm {

class Ghosts {
 public:
  /// An item of this rank that another, or this one across a periodic side, holds a copy of.
  struct Sent {
    LocalIndex item;
    int image;  ///< what the caller makes of it
  };
  /// The ghosts from one rank are numbered [first, first + count), in the order in which it sends.
  struct Peer {
    int rank = 0;
    std::vector<Sent> sent{};
    LocalIndex first = 0, count = 0;
  };

  explicit Ghosts(MPI_Comm comm) : comm_(comm) {}

  /// Each rank names the same items for another as that one counts.
  void set(std::vector<Peer> peers);
  using Adjust = std::function<void(int image, std::span<double> values)>;
  /// values[item * width + k]: from the items to their ghosts, each `adjust`ed on the way. Ranks
  /// that share ghosts call it together.
  void update(std::span<double> values, int width, const Adjust& adjust = {});

  GlobalIndex messages() const { return messages_; }  ///< sent by this rank since the start
  GlobalIndex bytes_sent() const { return bytes_sent_; }
  double waiting_seconds() const { return waiting_seconds_; }

 private:
  MPI_Comm comm_;
  std::vector<Peer> peers_;
  std::vector<double> buffer_;
  std::vector<MPI_Request> requests_;
  GlobalIndex messages_ = 0, bytes_sent_ = 0;
  double waiting_seconds_ = 0;
};

}  // namespace mpm
