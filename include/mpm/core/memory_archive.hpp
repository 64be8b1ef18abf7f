#pragma once
/// State kept in memory: to go back to, to compare, or on its way to a file.

#include <mpm/core/archive.hpp>

#include <functional>
#include <map>
#include <variant>

namespace mpm {

/// Owners of state save themselves into it, and load themselves from it as often as wanted. Names
/// of sections and values are joined by strokes: `body0/motion/velocity`.
///
/// Whoever met with an error while loading is half loaded and of no more use.
class MemoryArchive final : public Archive {
 public:
  /// What is named from now on is saved, in the memory of what bore its name before; the rest of
  /// what was there is forgotten.
  void start_saving();
  /// What is named from now on is loaded.
  void start_loading();

  bool is_loading() const override { return loading_; }
  void values(std::string_view name, std::span<double> values, Over over = Over::same) override;
  void values(std::string_view name, std::span<std::int64_t> values,
              Over over = Over::same) override;
  void list(std::string_view name, std::vector<double>& list) override;
  void list(std::string_view name, std::vector<std::int64_t>& list) override;
  void text(std::string_view name, std::string& text) override;
  void rows(std::string_view name, std::span<const std::int64_t>, std::span<double> values) override
  {
    this->values(name, values);
  }
  void rows(std::string_view name, std::span<const std::int64_t>,
            std::span<std::int64_t> values) override
  {
    this->values(name, values);
  }
  std::vector<std::string> unread() const override;

  using Value = std::variant<std::vector<double>, std::vector<std::int64_t>, std::string>;
  /// Of all that is there, in alphabetical order.
  void visit(const std::function<void(const std::string& name, const Value& value)>& visit) const;
  /// As if it had been saved by this whole name.
  void put(std::string name, Value value);

  /// What only one of the two has, or what is not the same to the last bit, in alphabetical order.
  friend std::vector<std::string> differences(const MemoryArchive& a, const MemoryArchive& b);

 private:
  struct Entry {
    Value value;
    bool read = false;
  };

  [[noreturn]] static void does_not_regroup();
  std::vector<std::int64_t> places_of(std::string_view, std::span<const std::int64_t>) override
  {
    does_not_regroup();
  }
  std::vector<std::int64_t> rows_where(std::string_view, int,
                                       const std::function<bool(std::span<const double>)>&) override
  {
    does_not_regroup();
  }
  void pass_over(std::string_view) override { does_not_regroup(); }
  void enter(std::string_view name) override;
  void leave() override;
  std::string full(std::string_view name) const;
  template <class T>
  void save(std::string_view name, const T& values);
  template <class T>
  const T& load(std::string_view name);
  template <class T>
  void fixed(std::string_view name, std::span<T> values);
  template <class T>
  void whole(std::string_view name, T& value);

  using Entries = std::map<std::string, Entry, std::less<>>;
  Entries entries_;
  Entries spare_;                      ///< whose memory is used again
  std::vector<std::string> sections_;  ///< those that are open
  bool loading_ = false;
};

}  // namespace mpm
