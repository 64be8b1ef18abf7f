#include <mpm/output/replace_file.hpp>
#include <mpm/output/summary.hpp>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace mpm::output {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value)
{
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json list_of(const std::vector<double>& values)
{
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

}  // namespace

void Summary::set(std::string key, const std::optional<double>& value)
{
  put(std::move(key), value ? Value(*value) : Value());
}

Summary& Summary::section(const std::string& key)
{
  for (auto& [name, value] : entries_)
    if (auto* nested = std::get_if<std::unique_ptr<Summary>>(&value); nested && name == key)
      return **nested;
  auto nested = std::make_unique<Summary>();
  Summary& made = *nested;
  put(key, std::move(nested));
  return made;
}

void Summary::put(std::string key, Value value)
{
  const auto old = std::find_if(entries_.begin(), entries_.end(),
                                [&](const auto& entry) { return entry.first == key; });
  if (old != entries_.end())
    old->second = std::move(value);
  else
    entries_.emplace_back(std::move(key), std::move(value));
}

std::string Summary::text() const
{
  Json json = Json::object();
  for (const auto& [key, value] : entries_) {
    if (const auto* logical = std::get_if<bool>(&value))
      json[key] = *logical;
    else if (const auto* integer = std::get_if<std::int64_t>(&value))
      json[key] = *integer;
    else if (const auto* real = std::get_if<double>(&value))
      json[key] = number(*real);
    else if (const auto* words = std::get_if<std::string>(&value))
      json[key] = *words;
    else if (const auto* nested = std::get_if<std::unique_ptr<Summary>>(&value))
      json[key] = Json::parse((*nested)->text());
    else if (const auto* list = std::get_if<std::vector<double>>(&value))
      json[key] = list_of(*list);
    else if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&value))
      json[key] = *integers;
    else if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
      json[key] = *texts;
    else
      json[key] = nullptr;
  }
  // A path name need not be UTF-8, but JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

void Summary::write(const std::filesystem::path& file) const
{
  replace_file(file, text() + '\n');
}

}  // namespace mpm::output
