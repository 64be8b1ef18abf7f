#pragma once
/// The particles of one body on this rank: columns in blocks of lanes.
///
/// Two groups of columns lie apart, because one of the two passes over the particles touches the
/// motion only. Inside a group, block b holds `lane_count` particles, column after column:
/// value(column, particle) = group[(particle / W * columns + column) * W + particle % W].
/// Lanes behind the last particle are padding: they sit where a real particle sits, but carry no
/// mass and no volume, so that kernels need no special case for them.

#include <mpm/core/archive.hpp>
#include <mpm/core/lane_vector.hpp>
#include <mpm/core/lanes.hpp>
#include <mpm/core/types.hpp>

#include <span>
#include <string>
#include <vector>

namespace mpm {

/// A named field with its components in consecutive columns.
struct Column {
  std::string name;
  int components = 1;
  std::string unit;
};

/// Columns that belong together in memory.
class ColumnGroup {
 public:
  explicit ColumnGroup(std::vector<Column> columns);

  int width() const { return width_; }  ///< columns, all components counted
  const std::vector<Column>& columns() const { return columns_; }
  /// First column of a named field; -1 if there is none.
  int find(const std::string& name) const;

  double* block(LocalIndex b) { return data_.data() + std::size_t(b) * width_ * lane_count; }
  const double* block(LocalIndex b) const
  {
    return data_.data() + std::size_t(b) * width_ * lane_count;
  }
  double& operator()(int column, LocalIndex particle)
  {
    return block(particle / lane_count)[column * lane_count + particle % lane_count];
  }
  double operator()(int column, LocalIndex particle) const
  {
    return block(particle / lane_count)[column * lane_count + particle % lane_count];
  }

  void resize(LocalIndex particles);
  void reserve(LocalIndex particles);
  void copy_particle(LocalIndex from, LocalIndex to);
  /// Particle k becomes the one that was at order[k]. `scratch` is for reuse.
  void permute(std::span<const LocalIndex> order, std::vector<double>& scratch);
  std::size_t bytes() const { return data_.capacity() * sizeof(double); }
  /// Of so many particles, column by column; regrouped, they are these of all.
  void archive(Archive& archive, LocalIndex particles, std::span<const std::int64_t> rows);

 private:
  std::vector<Column> columns_;
  int width_ = 0;
  LaneVector<double> data_;
};

class ParticleStore {
 public:
  /// `zero_in_padding` names the columns (of either group) that are 0 in lanes without a particle.
  ParticleStore(std::vector<Column> motion, std::vector<Column> state,
                std::vector<std::string> zero_in_padding);

  LocalIndex size() const { return LocalIndex(ids_.size()); }
  LocalIndex blocks() const { return (size() + lane_count - 1) / lane_count; }

  ColumnGroup& motion() { return motion_; }
  const ColumnGroup& motion() const { return motion_; }
  ColumnGroup& state() { return state_; }
  const ColumnGroup& state() const { return state_; }
  std::span<const GlobalIndex> ids() const { return ids_; }

  /// Memory for this many, so that adding them neither copies nor takes more.
  void reserve(LocalIndex particles);
  /// Adds a particle whose columns are all zero; `seal` when the last one is filled.
  LocalIndex add(GlobalIndex id);
  /// Doubles that one packed particle takes.
  int packed_size() const { return 1 + motion_.width() + state_.width(); }
  void pack(LocalIndex particle, std::vector<double>& buffer) const;
  /// Appends the packed particles of the buffer; `seal` afterwards.
  void unpack(std::span<const double> buffer);
  /// Removes particles (ascending, no duplicates); the last ones fill the gaps. `seal` afterwards.
  void erase(std::span<const LocalIndex> particles);
  void permute(std::span<const LocalIndex> order);
  /// Fills the padding lanes; every change of the number or the order of particles ends with it.
  void seal();

  std::size_t bytes() const
  {
    return motion_.bytes() + state_.bytes() + ids_.capacity() * sizeof(GlobalIndex);
  }
  /// All particles in their order.
  void archive(Archive& archive);
  /// Regrouped: takes these of all ranks' particles, in the place of those that are here.
  void take(Archive& archive, std::span<const std::int64_t> rows);

 private:
  void archive_columns(Archive& archive, std::span<const std::int64_t> rows);
  ColumnGroup motion_, state_;
  std::vector<GlobalIndex> ids_;
  std::vector<int> zero_motion_, zero_state_;
  std::vector<double> scratch_;
};

}  // namespace mpm
