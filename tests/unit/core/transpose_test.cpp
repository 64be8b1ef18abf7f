#include <mpm/core/transpose.hpp>

#include <array>

#include <gmock/gmock.h>

namespace mpm {
namespace {

/// Of value k in row `lane`.
double value(int lane, int k)
{
  return 10 * lane + k + 1;
}

template <int Width>
class Rows {
 public:
  /// Values behind each row, too, which belong to none.
  static constexpr int stride = Width + 3;

  Rows()
  {
    values_.fill(-1);
    for (int lane = 0; lane < lane_count; ++lane)
      for (int k = 0; k < Width; ++k) values_[place(lane, k)] = value(lane, k);
  }
  const double* row(int lane) const { return &values_[place(lane, 0)]; }

 private:
  /// The last lane's row stands first.
  static std::size_t place(int lane, int k)
  {
    return std::size_t((lane_count - 1 - lane) * stride + k);
  }
  std::array<double, std::size_t(lane_count* stride)> values_;
};

template <int Width>
void expect_columns()
{
  const Rows<Width> rows;
  Lanes columns[Width];
  to_columns([&](int lane) { return rows.row(lane); }, columns);
  for (int k = 0; k < Width; ++k)
    for (int lane = 0; lane < lane_count; ++lane)
      EXPECT_EQ(columns[k][std::size_t(lane)], value(lane, k))
          << "value " << k << ", lane " << lane;
}

TEST(ToColumns, CollectsEachValueOfRowsOfTwo)
{
  expect_columns<2>();
}

TEST(ToColumns, CollectsEachValueOfRowsOfFour)
{
  expect_columns<4>();
}

Lanes column(int k)
{
  return Lanes([k](auto lane) { return value(int(lane), k); });
}

TEST(ToRows, PutsTwoValuesOfALaneSideBySide)
{
  std::array<double, std::size_t(2 * lane_count)> rows;
  to_rows(column(0), column(1), rows.data());
  for (int lane = 0; lane < lane_count; ++lane)
    for (int k = 0; k < 2; ++k)
      EXPECT_EQ(rows[std::size_t(2 * lane + k)], value(lane, k))
          << "value " << k << ", lane " << lane;
}

TEST(ToRows, PutsFourValuesOfALaneSideBySideAndLeavesWhatIsBetweenRows)
{
  constexpr std::size_t stride = 5;
  std::array<double, stride * lane_count> rows;
  rows.fill(-1);
  to_rows(column(0), column(1), column(2), column(3), rows.data(), stride);
  for (int lane = 0; lane < lane_count; ++lane) {
    const double* row = &rows[std::size_t(lane) * stride];
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(row[k], value(lane, k)) << "value " << k << ", lane " << lane;
    EXPECT_EQ(row[4], -1) << "behind lane " << lane;
  }
}

}  // namespace
}  // namespace mpm
