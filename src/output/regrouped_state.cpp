#include <mpm/core/error.hpp>
#include <mpm/output/regrouped_state.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <numeric>

#include "state_contents.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mpm::output {

namespace {

constexpr const char* remedy = "Go on with the scene and the program that wrote it.";

/// Values that are read at once.
constexpr std::int64_t piece = 1 << 18;

template <class T>
constexpr char letter_of = std::is_same_v<T, double> ? 'd' : 'i';

/// Places in a list, from its least number to its greatest.
std::vector<std::size_t> ascending(std::span<const std::int64_t> list)
{
  std::vector<std::size_t> order(list.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t k) { return list[k]; });
  return order;
}

/// Of two ranks' values.
template <class T>
T together(T one, T other, Over over)
{
  return over == Over::sum ? one + other : std::max(one, other);
}

}  // namespace

RegroupedState::RegroupedState(MPI_Comm comm, const std::filesystem::path& file)
    : is_first_(rank_of(comm) == 0), input_(file)
{
  agree(comm, [&] {
    entries_ = state_entries(input_);
    const int ranks = int(input_.attribute("ranks"));
    for (const auto& [name, entry] : entries_) {
      read_[name] = false;
      for (int rank = rank_of(comm); rank < ranks; rank += ranks_of(comm))
        read_part(input_, name, entry, rank);
    }
  });
}

RegroupedState::~RegroupedState() = default;

std::string RegroupedState::full(std::string_view name) const
{
  return fmt::format("{}{}{}", fmt::join(sections_, "/"), sections_.empty() ? "" : "/", name);
}

RegroupedState::Value RegroupedState::find(std::string_view name)
{
  const std::string place = full(name);
  const auto found = entries_.find(place);
  if (found == entries_.end())
    throw InputError(fmt::format("{}: {} is not there. {}", input_.file().string(), place, remedy));
  read_[place] = true;
  return {place, found->second};
}

/// On every rank.
RegroupedState::Value RegroupedState::find_same(std::string_view name)
{
  const Value value = find(name);
  const auto all_equal = [](const std::vector<std::int64_t>& list) {
    return std::ranges::adjacent_find(list, std::not_equal_to()) == list.end();
  };
  if (!all_equal(value.entry.lengths) || !all_equal(value.entry.checksums))
    throw InputError(fmt::format("{}: {} differs between ranks. Go on with mpirun -n {}.",
                                 input_.file().string(), value.name, value.entry.lengths.size()));
  return value;
}

template <class T>
void RegroupedState::combine(std::string_view name, std::span<T> values, Over over)
{
  const Value found = over == Over::same ? find_same(name) : find(name);
  for (const std::int64_t length : found.entry.lengths)
    if (length != std::int64_t(values.size()) || found.entry.letter != letter_of<T>)
      throw InputError(fmt::format("{}: {} is not {} numbers. {}", input_.file().string(),
                                   found.name, values.size(), remedy));
  const int ranks = over == Over::same ? 1 : int(found.entry.lengths.size());
  for (int rank = 0; rank < ranks; ++rank) {
    const auto part = std::get<std::vector<T>>(read_part(input_, found.name, found.entry, rank));
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = rank == 0 ? part[k] : together(values[k], part[k], over);
  }
  if (over == Over::sum && !is_first_) std::ranges::fill(values, T(0));
}

void RegroupedState::values(std::string_view name, std::span<double> values, Over over)
{
  combine(name, values, over);
}

void RegroupedState::values(std::string_view name, std::span<std::int64_t> values, Over over)
{
  combine(name, values, over);
}

void RegroupedState::list(std::string_view name, std::vector<double>& list)
{
  list.resize(std::size_t(find_same(name).entry.lengths.front()));
  combine(name, std::span(list), Over::same);
}

void RegroupedState::list(std::string_view name, std::vector<std::int64_t>& list)
{
  list.resize(std::size_t(find_same(name).entry.lengths.front()));
  combine(name, std::span(list), Over::same);
}

void RegroupedState::text(std::string_view name, std::string& text)
{
  const Value found = find_same(name);
  text = std::get<std::string>(read_part(input_, found.name, found.entry, 0));
}

template <class T>
void RegroupedState::take_rows(std::string_view name, std::span<const std::int64_t> rows,
                               std::span<T> values)
{
  const Value found = find(name);
  if (rows.empty() || values.empty()) return;
  const auto width = std::int64_t(values.size() / rows.size());
  const std::int64_t all = found.entry.length();
  std::vector<T> read;
  std::int64_t first = 0;
  for (const std::size_t k : ascending(rows)) {
    const std::int64_t at = rows[k] * width;
    if (at + width > first + std::int64_t(read.size())) {
      first = at;
      read = input_.read_rows<T>(dataset_of(found.name), first,
                                 std::min(std::max(piece, width), all - first));
    }
    std::copy_n(read.begin() + (at - first), width, values.begin() + std::ptrdiff_t(k) * width);
  }
}

void RegroupedState::rows(std::string_view name, std::span<const std::int64_t> rows,
                          std::span<double> values)
{
  take_rows(name, rows, values);
}

void RegroupedState::rows(std::string_view name, std::span<const std::int64_t> rows,
                          std::span<std::int64_t> values)
{
  take_rows(name, rows, values);
}

std::vector<std::int64_t> RegroupedState::places_of(std::string_view name,
                                                    std::span<const std::int64_t> keys)
{
  const Value found = find(name);
  const std::vector<std::size_t> order = ascending(keys);
  std::vector<std::int64_t> places(keys.size(), -1);
  const std::int64_t all = found.entry.length();
  for (std::int64_t first = 0; first < all; first += piece) {
    const std::vector<std::int64_t> read =
        input_.read_rows<std::int64_t>(dataset_of(found.name), first, std::min(piece, all - first));
    for (std::size_t row = 0; row < read.size(); ++row) {
      const auto key_at = [&](std::size_t k) { return keys[k]; };
      for (auto at = std::ranges::lower_bound(order, read[row], {}, key_at);
           at != order.end() && keys[*at] == read[row]; ++at)
        places[*at] = first + std::int64_t(row);
    }
  }
  return places;
}

std::vector<std::int64_t> RegroupedState::rows_where(
    std::string_view name, int width,
    const std::function<bool(std::span<const double> row)>& wanted)
{
  const Value found = find(name);
  const std::int64_t all = found.entry.length() / width;
  std::vector<std::int64_t> rows;
  const std::int64_t at_once = piece / width;
  for (std::int64_t first = 0; first < all; first += at_once) {
    const std::int64_t count = std::min(at_once, all - first);
    const std::vector<double> read =
        input_.read_rows<double>(dataset_of(found.name), first * width, count * width);
    for (std::int64_t row = 0; row < count; ++row)
      if (wanted({read.data() + row * width, std::size_t(width)})) rows.push_back(first + row);
  }
  return rows;
}

void RegroupedState::pass_over(std::string_view section)
{
  const std::string within = full(section) + '/';
  for (auto& [name, read] : read_)
    if (name.starts_with(within)) read = true;
}

std::vector<std::string> RegroupedState::unread() const
{
  std::vector<std::string> names;
  for (const auto& [name, read] : read_)
    if (!read) names.push_back(name);
  return names;
}

}  // namespace mpm::output
