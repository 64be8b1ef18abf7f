#include <mpm/core/error.hpp>
#include <mpm/core/memory_archive.hpp>

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

namespace mpm {

namespace {

constexpr const char* remedy = "Load it into what was set up as the one that was saved.";

const char* kind_of(const std::vector<double>&)
{
  return "numbers";
}
const char* kind_of(const std::vector<std::int64_t>&)
{
  return "whole numbers";
}
const char* kind_of(const std::string&)
{
  return "text";
}

/// By bits: a NaN that has stayed is the same, and a zero that changed its sign is not.
template <class T>
bool same(const T& a, const T& b)
{
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0);
}

}  // namespace

void MemoryArchive::start_saving()
{
  spare_ = std::exchange(entries_, {});
  loading_ = false;
}

void MemoryArchive::start_loading()
{
  for (auto& [name, entry] : entries_) entry.read = false;
  loading_ = true;
}

void MemoryArchive::does_not_regroup()
{
  throw std::logic_error("a state in memory is of these ranks");
}

void MemoryArchive::enter(std::string_view name)
{
  sections_.emplace_back(name);
}

void MemoryArchive::leave()
{
  sections_.pop_back();
}

std::string MemoryArchive::full(std::string_view name) const
{
  return fmt::format("{}{}{}", fmt::join(sections_, "/"), sections_.empty() ? "" : "/", name);
}

template <class T>
void MemoryArchive::save(std::string_view name, const T& values)
{
  // T may be a span, the value is a list of the same.
  using Kept = std::conditional_t<std::is_same_v<T, std::string>, std::string,
                                  std::vector<typename T::value_type>>;
  const std::string place = full(name);
  if (entries_.contains(place)) throw std::logic_error("two values of the name " + place);
  Value& value = entries_[place].value;
  if (const auto before = spare_.find(place);
      before != spare_.end() && std::holds_alternative<Kept>(before->second.value))
    value = std::move(before->second.value);
  else
    value = Kept{};
  std::get<Kept>(value).assign(values.begin(), values.end());
}

template <class T>
const T& MemoryArchive::load(std::string_view name)
{
  const std::string place = full(name);
  const auto found = entries_.find(place);
  if (found == entries_.end())
    throw InputError(fmt::format("saved state: {} is not there. {}", place, remedy));
  Entry& entry = found->second;
  const T* value = std::get_if<T>(&entry.value);
  if (!value) {
    const char* kind = std::visit([](const auto& v) { return kind_of(v); }, entry.value);
    throw InputError(
        fmt::format("saved state: {} is {}, not {}. {}", place, kind, kind_of(T{}), remedy));
  }
  entry.read = true;
  return *value;
}

template <class T>
void MemoryArchive::fixed(std::string_view name, std::span<T> values)
{
  if (!loading_) return save(name, values);
  const auto& saved = load<std::vector<T>>(name);
  if (saved.size() != values.size())
    throw InputError(fmt::format("saved state: {} has {} values, not {}. {}", full(name),
                                 saved.size(), values.size(), remedy));
  std::ranges::copy(saved, values.begin());
}

template <class T>
void MemoryArchive::whole(std::string_view name, T& value)
{
  if (loading_)
    value = load<T>(name);
  else
    save(name, value);
}

void MemoryArchive::values(std::string_view name, std::span<double> values, Over)
{
  fixed(name, values);
}

void MemoryArchive::values(std::string_view name, std::span<std::int64_t> values, Over)
{
  fixed(name, values);
}

void MemoryArchive::list(std::string_view name, std::vector<double>& list)
{
  whole(name, list);
}

void MemoryArchive::list(std::string_view name, std::vector<std::int64_t>& list)
{
  whole(name, list);
}

void MemoryArchive::text(std::string_view name, std::string& text)
{
  whole(name, text);
}

void MemoryArchive::visit(
    const std::function<void(const std::string& name, const Value& value)>& visit) const
{
  for (const auto& [name, entry] : entries_) visit(name, entry.value);
}

void MemoryArchive::put(std::string name, Value value)
{
  entries_[std::move(name)].value = std::move(value);
}

std::vector<std::string> MemoryArchive::unread() const
{
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_)
    if (!entry.read) names.push_back(name);
  return names;
}

std::vector<std::string> differences(const MemoryArchive& a, const MemoryArchive& b)
{
  std::vector<std::string> names;
  for (const auto& [name, entry] : a.entries_) {
    const auto other = b.entries_.find(name);
    const bool equal =
        other != b.entries_.end() && std::visit(
                                         []<class T, class U>(const T& x, const U& y) {
                                           if constexpr (std::is_same_v<T, U>)
                                             return same(x, y);
                                           else
                                             return false;
                                         },
                                         entry.value, other->second.value);
    if (!equal) names.push_back(name);
  }
  for (const auto& [name, entry] : b.entries_)
    if (!a.entries_.contains(name)) names.push_back(name);
  std::ranges::sort(names);
  return names;
}

}  // namespace mpm
