#pragma once
/// Values with units, as people write them (`10.6 GPa`, `60 %`), to SI and back.

#include <mpm/core/quantity.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

struct ut_system;

namespace mpm {

std::string_view noun(Quantity quantity);     ///< `a pressure`
std::string_view example(Quantity quantity);  ///< `10.6 GPa`
std::string_view si_unit(Quantity quantity);  ///< `Pa`; empty if dimensionless

/// A text that is no value of the quantity asked for: what() says why.
class UnitError : public std::runtime_error {
 public:
  UnitError(const std::string& reason, std::string remedy)
      : std::runtime_error(reason), remedy_(std::move(remedy))
  {
  }
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

/// `10.6 GPa` apart: the number, its digits as written, and the unit (may be empty).
struct Measure {
  double number;
  std::string_view digits;
  std::string_view unit;
};
/// Nothing if the text does not begin with a finite number.
std::optional<Measure> split_number_and_unit(std::string_view text);

/// The installed table of units. Throws FileError if its database cannot be read.
class UnitTable {
 public:
  explicit UnitTable(const char* xml_file = nullptr);  ///< nullptr: where the library looks
  ~UnitTable();
  UnitTable(const UnitTable&) = delete;
  UnitTable& operator=(const UnitTable&) = delete;

  /// Throws UnitError.
  double to_si(std::string_view text, Quantity quantity) const;

 private:
  std::optional<double> factor(const std::string& unit, Quantity quantity) const;
  [[noreturn]] void explain(const std::string& unit, Quantity quantity) const;

  ut_system* system_;
};

/// By the one table of the program, read at the first call (which may throw FileError).
double to_si(std::string_view text, Quantity quantity);

/// The shortest text in a customary unit that to_si turns back into exactly this value.
std::string in_readable_unit(double value, Quantity quantity);

}  // namespace mpm
