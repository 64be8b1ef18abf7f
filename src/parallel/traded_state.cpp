#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/parallel/traded_state.hpp>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mpm {

namespace {

/// Whole numbers travel as they are, in the bits of a double.
double packed(double value)
{
  return value;
}
double packed(std::int64_t value)
{
  return std::bit_cast<double>(value);
}
template <class T>
T unpacked(double value)
{
  if constexpr (std::is_same_v<T, double>)
    return value;
  else
    return std::bit_cast<T>(value);
}

}  // namespace

TradedState::TradedState(MPI_Comm comm, const MemoryArchive& saved) : comm_(comm)
{
  saved.visit([&](const std::string& name, const MemoryArchive::Value& value) {
    entries_.emplace(name, Entry{&value});
  });
}

std::string TradedState::full(std::string_view name) const
{
  return fmt::format("{}{}{}", fmt::join(sections_, "/"), sections_.empty() ? "" : "/", name);
}

template <class T>
const T& TradedState::find(std::string_view name)
{
  const auto found = entries_.find(full(name));
  const T* value = found == entries_.end() ? nullptr : std::get_if<T>(found->second.value);
  if (!value) throw std::logic_error("not saved, or not of this kind: " + full(name));
  found->second.read = true;
  return *value;
}

template <class T>
std::span<const T> TradedState::of_length(std::string_view name, std::size_t length)
{
  const auto& saved = find<std::vector<T>>(name);
  if (saved.size() != length) throw std::logic_error("saved with another length: " + full(name));
  return saved;
}

template <class T>
void TradedState::combine(std::string_view name, std::span<T> values, Over over)
{
  std::ranges::copy(of_length<T>(name, values.size()), values.begin());
  if (over != Over::largest) return;
  std::vector<double> largest(values.begin(), values.end());
  largest_over_ranks(comm_, largest);
  std::ranges::transform(largest, values.begin(), [](double value) { return T(value); });
}

void TradedState::values(std::string_view name, std::span<double> values, Over over)
{
  combine(name, values, over);
}

void TradedState::values(std::string_view name, std::span<std::int64_t> values, Over over)
{
  combine(name, values, over);
}

void TradedState::list(std::string_view name, std::vector<double>& list)
{
  list = find<std::vector<double>>(name);
}

void TradedState::list(std::string_view name, std::vector<std::int64_t>& list)
{
  list = find<std::vector<std::int64_t>>(name);
}

void TradedState::text(std::string_view name, std::string& text)
{
  text = find<std::string>(name);
}

/// Of a list that each rank has a part of, the first place of every rank's, and the end.
std::vector<std::int64_t> TradedState::starts_of(std::size_t length) const
{
  const auto own = double(length);
  std::vector<std::int64_t> starts{0};
  for (const double each : joined_over_ranks(comm_, std::span(&own, 1)))
    starts.push_back(starts.back() + std::int64_t(each));
  return starts;
}

template <class T>
void TradedState::take_rows(std::string_view name, std::span<const std::int64_t> rows,
                            std::span<T> values)
{
  const auto& saved = find<std::vector<T>>(name);
  const std::vector<std::int64_t> starts = starts_of(saved.size());
  const std::size_t width = rows.empty() ? 0 : values.size() / rows.size();
  // To each rank: the width, then which of its values begin a row.
  std::vector<std::vector<double>> asked(starts.size() - 1);
  std::vector<std::size_t> owner_of(rows.size());
  for (std::size_t k = 0; k < rows.size() && width > 0; ++k) {
    const std::int64_t place = rows[k] * std::int64_t(width);
    const auto owner = std::size_t(std::ranges::upper_bound(starts, place) - starts.begin()) - 1;
    owner_of[k] = owner;
    if (asked[owner].empty()) asked[owner].push_back(double(width));
    asked[owner].push_back(double(place - starts[owner]));
  }
  std::vector<std::vector<double>> given(asked.size());
  const std::vector<std::vector<double>> requests = traded_over_ranks(comm_, asked);
  for (std::size_t rank = 0; rank < requests.size(); ++rank)
    for (std::size_t k = 1; k < requests[rank].size(); ++k)
      for (std::size_t c = 0; c < std::size_t(requests[rank][0]); ++c)
        given[rank].push_back(packed(saved[std::size_t(requests[rank][k]) + c]));
  const std::vector<std::vector<double>> got = traded_over_ranks(comm_, given);
  std::vector<std::size_t> next(got.size(), 0);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t c = 0; c < width; ++c)
      values[k * width + c] = unpacked<T>(got[owner_of[k]][next[owner_of[k]]++]);
}

void TradedState::rows(std::string_view name, std::span<const std::int64_t> rows,
                       std::span<double> values)
{
  take_rows(name, rows, values);
}

void TradedState::rows(std::string_view name, std::span<const std::int64_t> rows,
                       std::span<std::int64_t> values)
{
  take_rows(name, rows, values);
}

/// Keys and those who look for them meet on the rank that a key names.
std::vector<std::int64_t> TradedState::places_of(std::string_view name,
                                                 std::span<const std::int64_t> keys)
{
  const auto& saved = find<std::vector<std::int64_t>>(name);
  const std::vector<std::int64_t> starts = starts_of(saved.size());
  const auto ranks = std::size_t(ranks_of(comm_));
  const auto meeting_place = [&](std::int64_t key) {
    // Fibonacci hashing: neighbours in the lattice are spread over the ranks.
    return std::size_t((std::uint64_t(key) * 0x9e3779b97f4a7c15u >> 32) % ranks);
  };
  // To each: how many keys stand here, they, and where; then those that are looked for.
  std::vector<std::vector<double>> out(ranks, std::vector<double>{0.0});
  const std::int64_t first = starts[std::size_t(rank_of(comm_))];
  for (std::size_t k = 0; k < saved.size(); ++k) {
    std::vector<double>& list = out[meeting_place(saved[k])];
    list.insert(list.end(), {packed(saved[k]), double(first + std::int64_t(k))});
    ++list.front();
  }
  for (const std::int64_t key : keys) out[meeting_place(key)].push_back(packed(key));
  const std::vector<std::vector<double>> in = traded_over_ranks(comm_, out);
  const auto end_of_saved = [](const std::vector<double>& list) {
    return 1 + 2 * std::size_t(list.front());
  };
  std::map<std::int64_t, double> places;
  for (const std::vector<double>& list : in)
    for (std::size_t k = 1; k < end_of_saved(list); k += 2)
      places.emplace(unpacked<std::int64_t>(list[k]), list[k + 1]);
  std::vector<std::vector<double>> answers(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank)
    for (std::size_t k = end_of_saved(in[rank]); k < in[rank].size(); ++k) {
      const auto found = places.find(unpacked<std::int64_t>(in[rank][k]));
      answers[rank].push_back(found == places.end() ? -1.0 : found->second);
    }
  const std::vector<std::vector<double>> got = traded_over_ranks(comm_, answers);
  std::vector<std::size_t> next(ranks, 0);
  std::vector<std::int64_t> found;
  for (const std::int64_t key : keys) {
    const std::size_t rank = meeting_place(key);
    found.push_back(std::int64_t(got[rank][next[rank]++]));
  }
  return found;
}

/// Whoever moves between ranks in memory has its keys.
std::vector<std::int64_t> TradedState::rows_where(
    std::string_view name, int, const std::function<bool(std::span<const double> row)>&)
{
  throw std::logic_error("rows are asked for by key: " + full(name));
}

void TradedState::pass_over(std::string_view section)
{
  const std::string within = full(section) + '/';
  for (auto& [name, entry] : entries_)
    if (name.starts_with(within)) entry.read = true;
}

std::vector<std::string> TradedState::unread() const
{
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_)
    if (!entry.read) names.push_back(name);
  return names;
}

}  // namespace mpm
