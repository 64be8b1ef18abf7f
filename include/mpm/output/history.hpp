#pragma once
/// Scalars over time as CSV, a line at a time: what is on disk is whole lines at every moment.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace mpm::output {

/// A column of history.csv; the header reads `name [unit]`.
struct HistoryColumn {
  std::string name;
  std::string unit;
};

/// Rank 0 only. Throws FileError.
class HistoryFile {
 public:
  HistoryFile(const std::filesystem::path& file, std::vector<HistoryColumn> columns);
  void append(std::span<const double> row);  ///< one value per column, 12 digits; flushed
  /// Takes away all lines but the first ones. Throws FileError.
  void cut(std::size_t lines);

 private:
  void write_line(const std::string& line);

  std::filesystem::path file_;
  std::ofstream stream_;
  std::size_t columns_;
  std::vector<std::uintmax_t> ends_;  ///< of the header and each line that is on disk complete
};

/// A history as read back: columns by name without the unit.
struct HistoryTable {
  std::filesystem::path file;
  std::vector<HistoryColumn> columns;
  std::vector<std::vector<double>> values;  ///< values[column][line], NaN where the file has none
  std::vector<std::string> words;           ///< of each column: where it has words, or nothing
  /// Throws InputError naming file and line if there is no such column, or one of words.
  const std::vector<double>& operator[](const std::string& name) const;
  bool has(const std::string& name) const;
};
/// Any comma-separated table with one header line. Cells may be empty, and columns that nobody asks
/// for hold words. Throws InputError naming file and line.
HistoryTable read_history(const std::filesystem::path& file);

}  // namespace mpm::output
