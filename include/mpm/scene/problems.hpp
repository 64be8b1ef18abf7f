#pragma once
/// Everything wrong with a scene, collected so that one run reports it all.

#include <mpm/core/formula.hpp>
#include <mpm/scene/document.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace mpm::scene {

class Problems {
 public:
  /// `path` is the key path concerned; `text` follows the place.
  void add(const Place& place, const std::string& path, const std::string& text);

  /// Whether those that are added now are counted and no more.
  bool full() const;

  /// Whether a problem concerns this path or something below it.
  bool concern(std::string_view path) const;

  /// Throws InputError with one line each, in the order of the file, options last; of many
  /// the first, and how many there are.
  void throw_if_any() const;

 private:
  struct Problem {
    Place place;
    std::string path, text;
  };
  std::vector<Problem> found_;  ///< the first ones
  std::size_t count_ = 0;
};

/// What the scene gives at one key path.
struct Given {
  const Node& node;
  std::string path;
  Problems& problems;
  const Definitions& definitions;  ///< that formulas may use

  /// `PATH is VALUE (REASON). REMEDY.`; returns false, so that a reader can return it.
  bool refuse(const std::string& reason, const std::string& remedy = "") const;
  Given item(std::size_t index) const;
  Given entry(const Entry& entry) const;
};

}  // namespace mpm::scene
