#pragma once
/// State by name, on its way out or back in: one function of each owner serves both, so that what
/// is saved is what is loaded.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mpm {

/// Names are unique within their section. Loading throws InputError for a name that is not there,
/// or values of another kind or number.
class Archive {
 public:
  virtual ~Archive() = default;

  virtual bool is_loading() const = 0;
  virtual void values(std::string_view name, std::span<double> values) = 0;
  virtual void values(std::string_view name, std::span<std::int64_t> values) = 0;
  /// A list whose length is part of the state.
  virtual void list(std::string_view name, std::vector<double>& list) = 0;
  virtual void list(std::string_view name, std::vector<std::int64_t>& list) = 0;
  virtual void text(std::string_view name, std::string& text) = 0;

  void value(std::string_view name, double& value) { values(name, std::span(&value, 1)); }
  void value(std::string_view name, std::int64_t& value) { values(name, std::span(&value, 1)); }
  void value(std::string_view name, int& value)
  {
    std::int64_t wide = value;
    this->value(name, wide);
    value = int(wide);
  }

  /// While it lives, names are within `name`.
  class Section {
   public:
    Section(Archive& archive, std::string_view name) : archive_(archive) { archive_.enter(name); }
    ~Section() { archive_.leave(); }
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

   private:
    Archive& archive_;
  };

 private:
  virtual void enter(std::string_view name) = 0;
  virtual void leave() = 0;
};

}  // namespace mpm
