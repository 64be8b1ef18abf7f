#pragma once
/// State that these ranks keep in memory, for other shares of their particles and nodes.

#include <mpm/core/memory_archive.hpp>

#include <map>

#include <mpi.h>

namespace mpm {

/// Loads what was saved on these ranks, after cells have gone from one to another: each asks for
/// its rows by key, whoever has them. Sums stay where they are, as their parts. Every rank loads
/// the same names in the same order: all members that load are collective.
class TradedState final : public Archive {
 public:
  /// `saved`: of this rank; it outlives this.
  TradedState(MPI_Comm comm, const MemoryArchive& saved);

  bool is_loading() const override { return true; }
  bool regroups() const override { return true; }
  void values(std::string_view name, std::span<double> values, Over over) override;
  void values(std::string_view name, std::span<std::int64_t> values, Over over) override;
  void list(std::string_view name, std::vector<double>& list) override;
  void list(std::string_view name, std::vector<std::int64_t>& list) override;
  void text(std::string_view name, std::string& text) override;
  void rows(std::string_view name, std::span<const std::int64_t> rows,
            std::span<double> values) override;
  void rows(std::string_view name, std::span<const std::int64_t> rows,
            std::span<std::int64_t> values) override;
  std::vector<std::int64_t> places_of(std::string_view name,
                                      std::span<const std::int64_t> keys) override;
  std::vector<std::int64_t> rows_where(
      std::string_view name, int width,
      const std::function<bool(std::span<const double> row)>& wanted) override;
  void pass_over(std::string_view section) override;
  std::vector<std::string> unread() const override;

 private:
  template <class T>
  const T& find(std::string_view name);
  template <class T>
  std::span<const T> of_length(std::string_view name, std::size_t length);
  template <class T>
  void combine(std::string_view name, std::span<T> values, Over over);
  std::vector<std::int64_t> starts_of(std::size_t length) const;
  template <class T>
  void take_rows(std::string_view name, std::span<const std::int64_t> rows, std::span<T> values);
  std::string full(std::string_view name) const;
  void enter(std::string_view name) override { sections_.emplace_back(name); }
  void leave() override { sections_.pop_back(); }

  struct Entry {
    const MemoryArchive::Value* value;
    bool read = false;
  };
  MPI_Comm comm_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::vector<std::string> sections_;
};

}  // namespace mpm
