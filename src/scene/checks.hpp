#pragma once
/// What no single key can tell: names that must exist, keys that contradict each other, limits that
/// depend on other keys.

#include <mpm/scene/problems.hpp>
#include <mpm/scene/schema.hpp>

#include <string>
#include <vector>

namespace mpm::scene {

/// A scene as read with the document it came from. Nothing is said about a key that is reported
/// already.
struct Checked {
  const SceneKeys& scene;
  const Node& root;
  Problems& problems;

  /// Whether the document has a value there.
  bool given(const std::string& path) const { return find(root, path) != nullptr; }
  bool sound(const std::string& path) const { return !problems.concern(path); }
  /// `PATH is VALUE (REASON). REMEDY.`
  void refuse(const std::string& path, const std::string& reason,
              const std::string& remedy = "") const;
  /// `PATH is missing (REASON). REMEDY.`, at the map that should hold it.
  void miss(const std::string& path, const std::string& reason, const std::string& remedy) const;
  /// `PATH does not go with OTHER (given at ...). Keep one of them.`
  void both_given(const std::string& path, const std::string& other) const;
  std::string material_path(std::size_t index) const;
  /// Empty where the list could not be read.
  std::vector<std::string> material_names() const;
};

void check_materials(const Checked& checked);
void check_specimen(const Checked& checked);
void check_sides(const Checked& checked);
void check_loads(const Checked& checked);
void check_contact(const Checked& checked);
void check_run(const Checked& checked);

}  // namespace mpm::scene
