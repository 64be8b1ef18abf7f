#include <mpm/core/nearest_name.hpp>
#include <mpm/core/printable.hpp>
#include <mpm/scene/parameter.hpp>

#include <fmt/format.h>

namespace mpm::scene {

std::vector<std::string> check_keys(const Given& given, const std::vector<std::string>& known)
{
  std::vector<std::string> meant;
  for (const Entry& entry : given.node.entries) {
    const std::string path = joined(given.path, entry.key);
    const bool is_known = std::ranges::find(known, entry.key) != known.end();
    if (given.problems.full()) {  // no scene: how many there are is all that is said of the rest
      if (!is_known) given.problems.add(entry.place, path, "unknown key");
      continue;
    }
    if (!is_known) {
      const auto nearest = nearest_name(entry.key, known);
      // Under the key it was meant for, so that nobody reports that one as missing.
      given.problems.add(
          entry.place, joined(given.path, nearest.value_or(entry.key)),
          fmt::format("unknown key '{}' ({})", shortened(entry.key), suggestion(entry.key, known)));
      meant.push_back(nearest.value_or(""));
    } else if (const Entry* first = given.node.find(entry.key); first != &entry) {
      given.problems.add(
          entry.place, path,
          fmt::format("{} is given twice (first at {}). Remove one.", path, first->place.text()));
      meant.push_back(entry.key);
    }
  }
  return meant;
}

void report_foreign(const Given& map, const Entry& entry, const std::string& belongs_to)
{
  const std::string path = joined(map.path, entry.key);
  map.problems.add(entry.place, path,
                   fmt::format("{} is {} (belongs to {} only). Remove it.", path,
                               entry.value.shown(), belongs_to));
}

void report_excluded(const Given& map, const Entry& entry, const Entry& other)
{
  const std::string path = joined(map.path, entry.key);
  map.problems.add(entry.value.place, path,
                   fmt::format("{} does not go with {} (given at {}). Keep one of them.", path,
                               joined(map.path, other.key), other.value.place.text()));
}

void report_missing(const Given& map, const std::string& key, const std::string& help,
                    const std::string& type)
{
  const std::string path = joined(map.path, key);
  std::string what = ": " + type;  // as on the reference page, without its markup
  std::erase(what, '`');
  if (type.starts_with("a map")) what = " as a map of keys";
  map.problems.add(map.node.place, path,
                   fmt::format("{} is missing ({}). Add it{}.", path, help, what));
}

std::string link_to(std::string_view section)
{
  std::string anchor(section);
  std::ranges::replace(anchor, ' ', '-');
  return fmt::format("a map: [{}](#{})", section, anchor);
}

std::string schema_reference(std::string_view section)
{
  std::string name(section);
  std::ranges::replace(name, ' ', '_');
  return "#/definitions/" + name;
}

}  // namespace mpm::scene
