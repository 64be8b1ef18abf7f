#include <mpm/core/error.hpp>
#include <mpm/output/history.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace mpm::output {

namespace {

std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view blank = " \t\r\"";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line)
{
  std::vector<std::string_view> cells;
  bool quoted = false;  // where a comma is part of a text
  std::size_t begin = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') quoted = !quoted;
    if (line[k] != ',' || quoted) continue;
    cells.push_back(trimmed(line.substr(begin, k - begin)));
    begin = k + 1;
  }
  cells.push_back(trimmed(line.substr(begin)));
  return cells;
}

/// `stress_piston [Pa]`; a column without brackets has no unit.
HistoryColumn column_of(std::string_view cell)
{
  const std::size_t open = cell.rfind('[');
  if (open == std::string_view::npos || cell.back() != ']') return {std::string(cell), ""};
  return {std::string(trimmed(cell.substr(0, open))),
          std::string(trimmed(cell.substr(open + 1, cell.size() - open - 2)))};
}

/// from_chars does not look at the locale, in which the comma may be the decimal point.
std::optional<double> number_of(std::string_view cell)
{
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& file, std::vector<HistoryColumn> columns)
    : file_(file), columns_(columns.size())
{
  MPM_ASSERT(!columns.empty());
  errno = 0;
  stream_.open(file_, std::ios::binary | std::ios::trunc);
  if (!stream_)
    throw FileError(fmt::format("{}: cannot create the history file ({}). Check the directory.",
                                file_.string(), std::strerror(errno)));
  std::string header;
  for (const HistoryColumn& column : columns)
    header += fmt::format("{}{} [{}]", header.empty() ? "" : ",", column.name, column.unit);
  write_line(header + '\n');
}

void HistoryFile::append(std::span<const double> row)
{
  MPM_ASSERT(row.size() == columns_);
  fmt::memory_buffer line;
  for (std::size_t c = 0; c < row.size(); ++c)
    fmt::format_to(std::back_inserter(line), "{}{:.12g}", c == 0 ? "" : ",", row[c]);
  line.push_back('\n');
  write_line(fmt::to_string(line));
}

void HistoryFile::write_line(const std::string& line)
{
  errno = 0;
  stream_ << line << std::flush;
  if (!stream_) {
    const std::string reason = std::strerror(errno);
    std::error_code ignored;  // a device such as a pipe cannot be cut
    // No half line stays behind.
    std::filesystem::resize_file(file_, ends_.empty() ? 0 : ends_.back(), ignored);
    throw FileError(fmt::format("{}: cannot write a line ({}). Free space on that disk.",
                                file_.string(), reason));
  }
  ends_.push_back((ends_.empty() ? 0 : ends_.back()) + line.size());
}

void HistoryFile::cut(std::size_t lines)
{
  MPM_ASSERT(lines < ends_.size());
  ends_.resize(lines + 1);
  std::error_code failure;
  std::filesystem::resize_file(file_, ends_.back(), failure);
  if (failure)
    throw FileError(fmt::format("{}: cannot take lines away ({}). Check the disk.", file_.string(),
                                failure.message()));
  stream_.seekp(std::streamoff(ends_.back()));
}

bool HistoryTable::has(const std::string& name) const
{
  return std::any_of(columns.begin(), columns.end(),
                     [&](const HistoryColumn& column) { return column.name == name; });
}

const std::vector<double>& HistoryTable::operator[](const std::string& name) const
{
  std::string known;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].name == name) {
      if (!words[c].empty()) throw InputError(words[c]);
      return values[c];
    }
    known += (c == 0 ? "" : ", ") + columns[c].name;
  }
  throw InputError(
      fmt::format("{}:1: there is no column '{}' (there are: {}).", file.string(), name, known));
}

HistoryTable read_history(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  std::string line;
  if (!stream || !std::getline(stream, line))
    throw InputError(
        fmt::format("{}: cannot be read or is empty. Give a CSV file with a header "
                    "line such as 'strain [1],stress_piston [Pa]'.",
                    file.string()));
  if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets mark UTF-8 so
  HistoryTable table;
  table.file = file;
  for (const std::string_view cell : cells_of(line)) table.columns.push_back(column_of(cell));
  table.values.resize(table.columns.size());
  table.words.resize(table.columns.size());

  for (int number = 2; std::getline(stream, line); ++number) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string_view> cells = cells_of(line);
    if (cells.size() != table.columns.size())
      throw InputError(fmt::format("{}:{}: the line has {} values (the header has {} columns).",
                                   file.string(), number, cells.size(), table.columns.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::optional<double> value = number_of(cells[c]);
      table.values[c].push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
      if (value || cells[c].empty() || !table.words[c].empty()) continue;
      table.words[c] = fmt::format("{}:{}: '{}' in column '{}' is not a number.", file.string(),
                                   number, cells[c], table.columns[c].name);
    }
  }
  return table;
}

}  // namespace mpm::output
