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

TEST(Pieces, InSpaceFacesConnectLayers)
{
  // A stair that winds up through the layers, a rod through all of them, and specks that touch it
  // along edges only.
  const std::vector<Rows> layers{{"00..", "...1", "...."},  //
                                 {".0..", "...1", "..2."},  //
                                 {".0..", ".0.1", "2..."},  //
                                 {"....", ".0.1", "...."}};
  Lattice<3> whole;
  whole.count = {4, 3, 4};
  whole.part = {{0, 0, 0}, whole.count};
  for (const Rows& layer : layers)
    for (const std::string& row : layer)
      for (const char c : row)
        whole.material.push_back(c == '.' ? Lattice<3>::empty : std::int8_t(c - '0'));
  const Pieces pieces = connected_pieces(whole);
  EXPECT_THAT(pieces.size, ElementsAre(6, 4, 1, 1));
  EXPECT_THAT(pieces.first, ElementsAre(0, 7, 22, 32));

  const auto left = [&](const PieceRules& rules) {
    std::vector<std::vector<std::int8_t>> found;
    for (const int parts : {1, 2, 3, 4, 7})
      on_parts(parts, [&](const Share& share) {
        Lattice<3> held = whole;
        held.part = slab(whole.part, share.part, share.parts);
        held.material.clear();
        for_each_index(held.part,
                       [&](const IndexVec<3>& at) { held.material.push_back(whole(at)); });
        std::vector<std::int8_t> material = whole.material;
        for (const auto& run : removed_runs(held, rules, share))
          std::fill_n(material.begin() + run.row * 4 + run.begin, run.end - run.begin,
                      Lattice<3>::empty);
        static std::mutex one_at_a_time;
        const std::lock_guard lock(one_at_a_time);
        found.push_back(material);
        EXPECT_EQ(material, found.front()) << "part " << share.part << " of " << parts;
      });
    return found.front();
  };
  std::vector<std::int8_t> without_specks = whole.material, stair_alone = whole.material;
  std::ranges::replace(without_specks, std::int8_t(2), Lattice<3>::empty);
  std::ranges::replace_if(
      stair_alone, [](int material) { return material > 0; }, Lattice<3>::empty);
  EXPECT_EQ(left({.fewest_locations = 2}), without_specks);
  EXPECT_EQ(left({.only_largest = true}), stair_alone);
}

TEST(Pieces, HangTogetherAcrossPeriodicSides)
{
  // A wall whose two halves lie at the sides, and a speck.
  const Rows across{"00.0.00",  //
                    "0.....0",  //
                    "00...00"};
  EXPECT_EQ(kept(across, {.only_largest = true}), (Rows{"00.....",  //
                                                        "0......",  //
                                                        "00....."}));
  EXPECT_EQ(kept(across, {.only_largest = true, .periodic = {true}}), (Rows{"00...00",  //
                                                                            "0.....0",  //
                                                                            "00...00"}));
  const Rows up{"0..", "0..", "...", "...", ".0.", "0..", "0.."};
  EXPECT_EQ(kept(up, {.only_largest = true, .periodic = {true}}),
            (Rows{"0..", "0..", "...", "...", "...", "...", "..."}));
  EXPECT_EQ(kept(up, {.fewest_locations = 3, .periodic = {false, true}}),
            (Rows{"0..", "0..", "...", "...", "...", "0..", "0.."}));
  // Corners alone do not connect there either.
  EXPECT_EQ(kept({"0...", "...0"}, {.fewest_locations = 2, .periodic = {true, true}}),
            (Rows{"....", "...."}));
}

}  // namespace
}  // namespace mpm::micrograph::test
