#pragma once
/// What a run was and what came out of it, as one JSON file for programs to read.

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mpm::output {

/// Keys keep the order in which they were first set; setting one again replaces its value.
/// NaN, infinity and an absent value become null: JSON has no other word for them.
class Summary {
 public:
  template <std::integral Integer>
  void set(std::string key, Integer value)
  {
    if constexpr (std::same_as<Integer, bool>)
      put(std::move(key), value);
    else
      put(std::move(key), std::int64_t(value));
  }
  void set(std::string key, double value) { put(std::move(key), value); }
  void set(std::string key, std::string value) { put(std::move(key), std::move(value)); }
  void set(std::string key, const char* value) { put(std::move(key), std::string(value)); }
  void set(std::string key, const std::optional<double>& value);
  void set(std::string key, std::vector<double> values) { put(std::move(key), std::move(values)); }
  void set(std::string key, std::vector<std::int64_t> values)
  {
    put(std::move(key), std::move(values));
  }

  void set(std::string key, std::vector<std::string> words)
  {
    put(std::move(key), std::move(words));
  }

  /// The nested object of that name, made if it is not there; the reference stays valid as long as
  /// this summary lives and the key is not set to something else.
  Summary& section(const std::string& key);

  std::string text() const;                             ///< indented JSON
  void write(const std::filesystem::path& file) const;  ///< whole or not at all; throws FileError

 private:
  using Value =
      std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>,
                   std::vector<std::int64_t>, std::vector<std::string>, std::unique_ptr<Summary>>;
  void put(std::string key, Value value);

  std::vector<std::pair<std::string, Value>> entries_;
};

}  // namespace mpm::output
