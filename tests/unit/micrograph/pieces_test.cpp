#include <mpm/micrograph/pieces.hpp>

#include <mutex>

#include "built_specimen.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using testing::ElementsAre;

using Rows = std::vector<std::string>;

/// '.' is void, '0', '1', ... a material; the bottom row first. The part's slab of them.
Lattice<2> lattice_of(const Rows& rows, const Share& share = {})
{
  Lattice<2> lattice;
  lattice.count = {LocalIndex(rows.front().size()), LocalIndex(rows.size())};
  lattice.part = slab(IndexBox<2>{{0, 0}, lattice.count}, share.part, share.parts);
  for (LocalIndex j = lattice.part.lower[1]; j < lattice.part.upper[1]; ++j)
    for (const char c : rows[std::size_t(j)])
      lattice.material.push_back(c == '.' ? Lattice<2>::empty : std::int8_t(c - '0'));
  return lattice;
}

/// What the rules leave; the same on every part, and for any number of them.
Rows kept(const Rows& rows, const PieceRules& rules)
{
  Rows left;
  for (const int parts : {1, 2, 3, 5, 8}) {
    on_parts(parts, [&](const Share& share) {
      Rows found = rows;
      for (const Run& run : removed_runs(lattice_of(rows, share), rules, share))
        for (LocalIndex i = run.begin; i < run.end; ++i)
          found[std::size_t(run.row)][std::size_t(i)] = '.';
      static std::mutex one_at_a_time;
      const std::lock_guard lock(one_at_a_time);
      if (left.empty()) left = found;
      EXPECT_EQ(found, left) << "part " << share.part << " of " << parts;
    });
  }
  return left;
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
  const Rows rows{"00..1.1",  //
                  "..0.1.1",  //
                  "......1"};
  EXPECT_THAT(kept(rows, {2}), ElementsAre("00..1.1", "....1.1", "......1"));
  EXPECT_THAT(kept(rows, {3}), ElementsAre("......1", "......1", "......1"));
}

TEST(LargestPiece, StaysAlone)
{
  EXPECT_THAT(kept({"00.1",  //
                    "...1",  //
                    "0..1"},
                   {0, true}),
              ElementsAre("...1", "...1", "...1"));
}

TEST(LargestPiece, FirstOfEquals)
{
  EXPECT_THAT(kept({"0.0"}, {0, true}), ElementsAre("0.."));
  EXPECT_THAT(kept({"..0", "..0", "...", "0..", "0.."}, {0, true}),
              ElementsAre("..0", "..0", "...", "...", "..."));
}

TEST(LargestPiece, OfArmsThatMeetInAnotherPart)
{
  // Every row of the comb is in a part of its own when there are five; the arms are joined at the
  // top only, and the bar in the middle is the largest piece of its part.
  EXPECT_THAT(kept({"0.0.0...",  //
                    "0.0.0...",  //
                    "0.0.0.00",  //
                    "0.0.0...",  //
                    "00000..."},
                   {3, true}),
              ElementsAre("0.0.0...", "0.0.0...", "0.0.0...", "0.0.0...", "00000..."));
}

}  // namespace
}  // namespace mpm::micrograph::test
