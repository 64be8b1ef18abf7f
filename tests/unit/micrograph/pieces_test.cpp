#include <mpm/micrograph/pieces.hpp>

#include <gmock/gmock.h>

namespace mpm::micrograph {
namespace {

using testing::ElementsAre;

/// '.' is void, '0', '1', ... a material; the bottom row first.
Lattice lattice_of(const std::vector<std::string>& rows)
{
  Lattice lattice;
  lattice.nx = int(rows.front().size());
  lattice.ny = int(rows.size());
  for (const std::string& row : rows)
    for (const char c : row)
      lattice.material.push_back(c == '.' ? Lattice::empty : std::int8_t(c - '0'));
  return lattice;
}

std::vector<std::string> rows_of(const Lattice& lattice)
{
  std::vector<std::string> rows(std::size_t(lattice.ny));
  for (int j = 0; j < lattice.ny; ++j)
    for (int i = 0; i < lattice.nx; ++i)
      rows[std::size_t(j)] += lattice(i, j) == Lattice::empty ? '.' : char('0' + lattice(i, j));
  return rows;
}

TEST(Pieces, ACommonCornerDoesNotConnect)
{
  const Pieces pieces = connected_pieces(lattice_of({"0.",  //
                                                     ".0"}));
  EXPECT_THAT(pieces.label, ElementsAre(0, -1, -1, 1));
  EXPECT_THAT(pieces.size, ElementsAre(1, 1));
}

TEST(Pieces, ArmsThatMeetLateAreOnePiece)
{
  // A comb and a spiral: provisional labels meet in rows above.
  const Pieces comb = connected_pieces(lattice_of({"0.0.0",  //
                                                   "0.0.0",  //
                                                   "00000"}));
  EXPECT_THAT(comb.size, ElementsAre(11));
  const Pieces spiral = connected_pieces(lattice_of({"000000",  //
                                                     ".....0",  //
                                                     "0000.0",  //
                                                     "0..0.0",  //
                                                     "0....0",  //
                                                     "000000"}));
  EXPECT_THAT(spiral.size, ElementsAre(23));
}

TEST(Pieces, AreNumberedByTheirFirstLocationWhateverJoinsInside)
{
  const Pieces pieces = connected_pieces(lattice_of({"0.0.0",  //
                                                     "000..",  //
                                                     "....0"}));
  EXPECT_THAT(pieces.label, ElementsAre(0, -1, 0, -1, 1,  //
                                        0, 0, 0, -1, -1,  //
                                        -1, -1, -1, -1, 2));
  EXPECT_THAT(pieces.size, ElementsAre(5, 1, 1));
}

TEST(Pieces, MaterialsThatTouchAreOnePiece)
{
  EXPECT_THAT(connected_pieces(lattice_of({"012"})).size, ElementsAre(3));
}

TEST(Pieces, OfAnEmptyLatticeAreNone)
{
  EXPECT_TRUE(connected_pieces(lattice_of({"..."})).size.empty());
}

TEST(Specks, PiecesWithFewerLocationsVanishAndThoseWithAsManyStay)
{
  Lattice lattice = lattice_of({"00..1.1",  //
                                "..0.1.1",  //
                                "......1"});
  EXPECT_EQ(remove_specks(lattice, 2), 1);
  EXPECT_THAT(rows_of(lattice), ElementsAre("00..1.1", "....1.1", "......1"));
  EXPECT_EQ(remove_specks(lattice, 3), 4);
  EXPECT_THAT(rows_of(lattice), ElementsAre("......1", "......1", "......1"));
}

TEST(LargestPiece, StaysAlone)
{
  Lattice lattice = lattice_of({"00.1",  //
                                "...1",  //
                                "0..1"});
  EXPECT_EQ(keep_largest_piece(lattice), 3);
  EXPECT_THAT(rows_of(lattice), ElementsAre("...1", "...1", "...1"));
}

TEST(LargestPiece, FirstOfEquals)
{
  Lattice lattice = lattice_of({"0.0"});
  EXPECT_EQ(keep_largest_piece(lattice), 1);
  EXPECT_THAT(rows_of(lattice), ElementsAre("0.."));
}

}  // namespace
}  // namespace mpm::micrograph
