#include <mpm/core/error.hpp>
#include <mpm/micrograph/anatomy_keys.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <variant>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace mpm::micrograph::anatomy {

namespace {

/// Edits (insert, delete, replace) that turn a into b (Levenshtein 1966).
std::size_t edits(std::string_view a, std::string_view b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file.string()) {}

  Parameters read()
  {
    const YAML::Node top = load();
    Parameters wood;
    wood.file = file_;
    const std::vector<std::string_view> sections{
        "seed",    "picture", "gray",        "irregularity", "files", "rays",
        "vessels", "density", "growth_ring", "resin_canals", "grain"};
    if (!is_map(top, "the file")) throw InputError(problems_);
    check_keys(top, sections);
    if (top["seed"]) read_seed(top["seed"], wood.seed);
    if (top["picture"])
      section(top["picture"], "picture", picture_rows, wood.picture);
    else
      problems_.push_back(file_ + ": picture is missing (its size in pixels and micrometres).");
    if (top["gray"]) section(top["gray"], "gray", gray_rows, wood.gray);
    if (top["irregularity"])
      section(top["irregularity"], "irregularity", irregularity_rows, wood.irregularity);
    if (top["files"]) read_files(top["files"], wood.files);
    if (top["growth_ring"]) section(top["growth_ring"], "growth_ring", ring_rows, wood.growth_ring);
    if (top["rays"]) section(top["rays"], "rays", rays_rows, wood.rays.emplace());
    if (top["vessels"]) section(top["vessels"], "vessels", vessels_rows, wood.vessels.emplace());
    if (top["grain"]) section(top["grain"], "grain", grain_rows, wood.grain.emplace());
    if (top["resin_canals"])
      list(top["resin_canals"], "resin_canals", canal_rows, wood.resin_canals);
    if (top["density"]) read_density(top["density"], wood.density.emplace());
    check_together(top, wood);
    if (!problems_.empty()) throw InputError(problems_);
    return wood;
  }

 private:
  YAML::Node load() const
  {
    try {
      return YAML::LoadFile(file_);
    } catch (const YAML::BadFile&) {
      throw FileError(file_ + ": cannot read the file (check its name and folder).");
    } catch (const YAML::ParserException& error) {
      throw InputError(place(error.mark) + error.msg +
                       " (not valid YAML). Write `key: value` lines, and close brackets.");
    }
  }

  std::string place(const YAML::Mark& mark) const
  {
    return fmt::format("{}:{}:{}: ", file_, mark.line + 1, mark.column + 1);
  }

  bool is_map(const YAML::Node& node, std::string_view path)
  {
    if (node.IsMap()) return true;
    problems_.push_back(
        fmt::format("{}{} holds no keys. Write `key: value` lines.", place(node.Mark()), path));
    return false;
  }

  void check_keys(const YAML::Node& map, const std::vector<std::string_view>& known)
  {
    for (const auto& entry : map) {
      const auto key = entry.first.as<std::string>();
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      const auto nearest = std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
        return edits(key, a) < edits(key, b);
      });
      problems_.push_back(fmt::format("{}unknown key '{}' (did you mean '{}'?)",
                                      place(entry.first.Mark()), key, *nearest));
    }
  }

  template <class T, std::size_t N>
  void section(const YAML::Node& map, const std::string& path, const Row<T> (&rows)[N], T& target,
               std::vector<std::string_view> known = {})
  {
    if (!is_map(map, path)) return;
    for (const Row<T>& row : rows) known.push_back(row.name);
    check_keys(map, known);
    for (const Row<T>& row : rows) {
      const YAML::Node node = map[std::string(row.name)];
      if (!node) continue;
      const std::string key = fmt::format("{}.{}", path, row.name);
      std::visit([&](auto member) { value(node, key, row.lowest, row.highest, target.*member); },
                 row.member);
    }
  }

  template <class Number>
  void value(const YAML::Node& node, const std::string& key, double lowest, double highest,
             Number& target)
  {
    Number read{};
    if (!node.IsScalar() || !YAML::convert<Number>::decode(node, read)) {
      problems_.push_back(fmt::format("{}{} is {} (must be a {}number).", place(node.Mark()), key,
                                      node.IsScalar() ? node.Scalar() : "not a single value",
                                      std::is_same_v<Number, int> ? "whole " : ""));
    } else if (!(read >= lowest && read <= highest)) {
      problems_.push_back(fmt::format("{}{} is {} (must be from {:g} to {:g}).", place(node.Mark()),
                                      key, node.Scalar(), lowest, highest));
    } else {
      target = read;
    }
  }

  template <class T, std::size_t N>
  void list(const YAML::Node& items, const std::string& path, const Row<T> (&rows)[N],
            std::vector<T>& target)
  {
    if (!items.IsSequence()) {
      problems_.push_back(fmt::format("{}{} is not a list (start each entry with `- `).",
                                      place(items.Mark()), path));
      return;
    }
    for (std::size_t k = 0; k < items.size(); ++k)
      section(items[k], fmt::format("{}[{}]", path, k), rows, target.emplace_back());
  }

  void read_seed(const YAML::Node& node, std::uint64_t& seed)
  {
    if (!node.IsScalar() || !YAML::convert<std::uint64_t>::decode(node, seed))
      problems_.push_back(place(node.Mark()) + "seed must be a whole number from 0 to 2^64 - 1.");
  }

  void read_files(const YAML::Node& node, Files& files)
  {
    section(node, "files", files_rows, files, {"earlywood", "latewood"});
    if (!node.IsMap()) return;
    if (node["earlywood"])
      section(node["earlywood"], "files.earlywood", cell_rows, files.earlywood);
    if (node["latewood"]) section(node["latewood"], "files.latewood", cell_rows, files.latewood);
  }

  void read_density(const YAML::Node& node, Density& density)
  {
    section(node, "density", density_rows, density, {"windows"});
    if (!node.IsMap()) return;
    if (node["windows"]) list(node["windows"], "density.windows", window_rows, density.windows);
    double reached = 0;
    for (const DensityWindow& window : density.windows) {
      if (std::abs(window.from - reached) > 1e-12 || window.to <= window.from) break;
      reached = window.to;
    }
    if (density.windows.empty() || reached != 1 || density.windows.back().to != 1)
      problems_.push_back(place(node.Mark()) +
                          "density.windows must follow each other from 0 to 1 without gaps.");
  }

  void check_together(const YAML::Node& top, const Parameters& wood)
  {
    if (wood.vessels && wood.vessels->largest < wood.vessels->smallest)
      problems_.push_back(fmt::format("{}vessels.largest is {:g} (below vessels.smallest, {:g}).",
                                      place(top["vessels"].Mark()), wood.vessels->largest,
                                      wood.vessels->smallest));
    if (wood.density &&
        (wood.gray.wall <= wood.density->threshold || wood.gray.lumen >= wood.density->threshold))
      problems_.push_back(fmt::format(
          "{}density.threshold is {:g} (must lie between gray.lumen, {:g}, and gray.wall, {:g}).",
          place(top["density"].Mark()), wood.density->threshold, wood.gray.lumen, wood.gray.wall));
  }

  std::string file_;
  std::vector<std::string> problems_;
};

}  // namespace

Parameters read_parameters(const std::filesystem::path& file)
{
  return Reader(file).read();
}

}  // namespace mpm::micrograph::anatomy
