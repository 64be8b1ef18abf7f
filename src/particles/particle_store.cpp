#include <mpm/core/error.hpp>
#include <mpm/particles/particle_store.hpp>

#include <algorithm>

namespace mpm {

ColumnGroup::ColumnGroup(std::vector<Column> columns) : columns_(std::move(columns))
{
  for (const Column& column : columns_) width_ += column.components;
}

int ColumnGroup::find(const std::string& name) const
{
  int first = 0;
  for (const Column& column : columns_) {
    if (column.name == name) return first;
    first += column.components;
  }
  return -1;
}

void ColumnGroup::resize(LocalIndex particles)
{
  const std::size_t blocks = (std::size_t(particles) + lane_count - 1) / lane_count;
  data_.resize(blocks * width_ * lane_count, 0.0);
}

void ColumnGroup::reserve(LocalIndex particles)
{
  const std::size_t blocks = (std::size_t(particles) + lane_count - 1) / lane_count;
  data_.reserve(blocks * width_ * lane_count);
}

void ColumnGroup::copy_particle(LocalIndex from, LocalIndex to)
{
  for (int c = 0; c < width_; ++c) (*this)(c, to) = (*this)(c, from);
}

void ColumnGroup::permute(std::span<const LocalIndex> order, std::vector<double>& scratch)
{
  // A few columns at a time: their lines stay in the nearest cache from the first particle of a
  // block to the last, and what is kept beside the store stays small.
  constexpr int together = 4;
  const auto place = [&](LocalIndex particle) {
    return std::size_t(particle / lane_count) * width_ * lane_count + particle % lane_count;
  };
  for (int first = 0; first < width_; first += together) {
    const int columns = std::min(together, width_ - first);
    scratch.resize(order.size() * columns);
    const double* from = data_.data() + std::size_t(first) * lane_count;
    for (std::size_t k = 0; k < order.size(); ++k)
      for (int c = 0; c < columns; ++c)
        scratch[k * columns + c] = from[place(order[k]) + c * lane_count];
    double* to = data_.data() + std::size_t(first) * lane_count;
    for (std::size_t k = 0; k < order.size(); ++k)
      for (int c = 0; c < columns; ++c)
        to[place(LocalIndex(k)) + c * lane_count] = scratch[k * columns + c];
  }
}

void ColumnGroup::archive(Archive& archive, LocalIndex particles,
                          std::span<const std::int64_t> rows)
{
  if (archive.is_loading()) resize(particles);
  int first = 0;
  std::vector<double> values;
  for (const Column& column : columns_) {
    values.resize(std::size_t(particles) * column.components);
    std::size_t next = 0;
    if (!archive.is_loading())
      for (LocalIndex p = 0; p < particles; ++p)
        for (int c = 0; c < column.components; ++c) values[next++] = (*this)(first + c, p);
    archive.rows(column.name, rows, values);
    if (archive.is_loading())
      for (LocalIndex p = 0; p < particles; ++p)
        for (int c = 0; c < column.components; ++c) (*this)(first + c, p) = values[next++];
    first += column.components;
  }
}

ParticleStore::ParticleStore(std::vector<Column> motion, std::vector<Column> state,
                             std::vector<std::string> zero_in_padding)
    : motion_(std::move(motion)), state_(std::move(state))
{
  const auto mark = [&](const ColumnGroup& group, std::vector<int>& marked) {
    for (const Column& column : group.columns())
      if (std::ranges::find(zero_in_padding, column.name) != zero_in_padding.end())
        for (int k = 0; k < column.components; ++k) marked.push_back(group.find(column.name) + k);
  };
  mark(motion_, zero_motion_);
  mark(state_, zero_state_);
}

void ParticleStore::reserve(LocalIndex particles)
{
  ids_.reserve(particles);
  motion_.reserve(particles);
  state_.reserve(particles);
}

LocalIndex ParticleStore::add(GlobalIndex id)
{
  const LocalIndex particle = size();
  ids_.push_back(id);
  motion_.resize(size());
  state_.resize(size());
  for (int c = 0; c < motion_.width(); ++c) motion_(c, particle) = 0;
  for (int c = 0; c < state_.width(); ++c) state_(c, particle) = 0;
  return particle;
}

void ParticleStore::pack(LocalIndex particle, std::vector<double>& buffer) const
{
  buffer.push_back(std::bit_cast<double>(ids_[particle]));
  for (int c = 0; c < motion_.width(); ++c) buffer.push_back(motion_(c, particle));
  for (int c = 0; c < state_.width(); ++c) buffer.push_back(state_(c, particle));
}

void ParticleStore::unpack(std::span<const double> buffer)
{
  MPM_ASSERT(buffer.size() % packed_size() == 0);
  const double* value = buffer.data();
  for (std::size_t k = buffer.size() / packed_size(); k > 0; --k) {
    const LocalIndex particle = add(std::bit_cast<GlobalIndex>(*value++));
    for (int c = 0; c < motion_.width(); ++c) motion_(c, particle) = *value++;
    for (int c = 0; c < state_.width(); ++c) state_(c, particle) = *value++;
  }
}

void ParticleStore::erase(std::span<const LocalIndex> particles)
{
  LocalIndex last = size();
  for (std::size_t k = particles.size(); k-- > 0;) {
    const LocalIndex gap = particles[k];
    --last;
    if (gap == last) continue;
    motion_.copy_particle(last, gap);
    state_.copy_particle(last, gap);
    ids_[gap] = ids_[last];
  }
  ids_.resize(last);
  motion_.resize(last);
  state_.resize(last);
}

void ParticleStore::permute(std::span<const LocalIndex> order)
{
  motion_.permute(order, scratch_);
  state_.permute(order, scratch_);
  std::vector<GlobalIndex> ids(ids_.size());
  for (std::size_t k = 0; k < order.size(); ++k) ids[k] = ids_[order[k]];
  ids_ = std::move(ids);
}

void ParticleStore::archive(Archive& archive)
{
  archive.list("id", ids_);
  archive_columns(archive, {});
}

void ParticleStore::take(Archive& archive, std::span<const std::int64_t> rows)
{
  ids_.resize(rows.size());
  archive.rows("id", rows, ids_);
  archive_columns(archive, rows);
}

void ParticleStore::archive_columns(Archive& archive, std::span<const std::int64_t> rows)
{
  {
    const Archive::Section section(archive, "motion");
    motion_.archive(archive, size(), rows);
  }
  {
    const Archive::Section section(archive, "state");
    state_.archive(archive, size(), rows);
  }
  if (archive.is_loading()) seal();
}

void ParticleStore::seal()
{
  for (LocalIndex lane = size(); lane < blocks() * lane_count; ++lane) {
    motion_.copy_particle(size() - 1, lane);
    state_.copy_particle(size() - 1, lane);
    for (const int c : zero_motion_) motion_(c, lane) = 0;
    for (const int c : zero_state_) state_(c, lane) = 0;
  }
}

}  // namespace mpm
