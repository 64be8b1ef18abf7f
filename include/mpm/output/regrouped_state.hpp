#pragma once
/// The state of a run, as another number of ranks wrote it, for these.

#include <mpm/core/archive.hpp>
#include <mpm/output/hdf5_input.hpp>

#include <map>
#include <memory>

#include <mpi.h>

namespace mpm::output {

struct StateEntry;

/// Loads from the file as it is asked, in pieces: no rank holds more than its own share and a
/// piece. Throws FileError for a file that is not whole, and InputError as `Archive` says, also for
/// a value that should be the same on every rank and was not.
class RegroupedState final : public Archive {
 public:
  /// The ranks check the checksums of all parts between them. Collective.
  RegroupedState(MPI_Comm comm, const std::filesystem::path& file);
  ~RegroupedState() override;

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
  struct Value {
    std::string name;
    const StateEntry& entry;
  };
  Value find(std::string_view name);
  Value find_same(std::string_view name);
  std::string full(std::string_view name) const;
  template <class T>
  void combine(std::string_view name, std::span<T> values, Over over);
  template <class T>
  void take_rows(std::string_view name, std::span<const std::int64_t> rows, std::span<T> values);
  void enter(std::string_view name) override { sections_.emplace_back(name); }
  void leave() override { sections_.pop_back(); }

  bool is_first_;  ///< rank, which has what all ranks have had
  Hdf5Input input_;
  std::map<std::string, StateEntry> entries_;
  std::map<std::string, bool, std::less<>> read_;
  std::vector<std::string> sections_;
};

}  // namespace mpm::output
