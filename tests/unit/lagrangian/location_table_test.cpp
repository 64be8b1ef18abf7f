// Values at locations against a map of them, and what is near a surface against its definition.
#include <mpm/lagrangian/location_mesh.hpp>
#include <mpm/lagrangian/location_table.hpp>

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

/// Some locations of a box that does not begin at 0, few tiles of which are full.
template <int Dim>
std::vector<IndexVec<Dim>> scattered(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<LocalIndex> place(-40, 60), near(0, 4);
  std::vector<IndexVec<Dim>> found;
  for (int group = 0; group < 12; ++group) {
    IndexVec<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = place(random);
    for (int k = 0; k < 20; ++k) {
      found.push_back(at);
      for (int d = 0; d < Dim; ++d) found.back()[d] += near(random);
    }
  }
  return found;
}

template <int Dim>
void expect_what_was_put()
{
  const std::vector<IndexVec<Dim>> locations = scattered<Dim>(3);
  const IndexBox<Dim> box = box_around<Dim>(locations);
  LocationTable<Dim, int> table(box, -1);
  std::map<std::vector<LocalIndex>, int> known;
  for (std::size_t k = 0; k < locations.size(); ++k) {
    table.at(locations[k]) = int(k);
    known[{locations[k].begin(), locations[k].end()}] = int(k);
  }
  const IndexVec<Dim> margin = IndexVec<Dim>::Constant(2);
  for_each_index(IndexBox<Dim>{box.lower - margin, box.upper + margin}, [&](const auto& at) {
    const auto found = known.find({at.begin(), at.end()});
    ASSERT_EQ(table(at), found == known.end() ? -1 : found->second);
  });
}

TEST(LocationTable, HasWhatWasPutAndNothingElse)
{
  expect_what_was_put<2>();
  expect_what_was_put<3>();
}

TEST(LocationTable, IsEmptyWithoutABox)
{
  const LocationTable<2, int> table(box_around<2>({}), 7);
  EXPECT_EQ(table(IndexVec<2>(0, 0)), 7);
}

template <int Dim>
void expect_near_surfaces()
{
  std::mt19937 random(5);
  const IndexBox<Dim> box{IndexVec<Dim>::Zero(), IndexVec<Dim>::Constant(Dim == 2 ? 40 : 14)};
  LocationTable<Dim, char> taken(box, 0);
  // So full that a cell with all around it is as likely as one without.
  std::bernoulli_distribution is_there(Dim == 2 ? 0.97 : 0.992);
  for_each_index(box, [&](const auto& at) { taken.at(at) = is_there(random); });
  const auto has_open_face = [&](const IndexVec<Dim>& at) {
    for (int d = 0; d < Dim; ++d)
      for (const int side : {-1, 1}) {
        IndexVec<Dim> next = at;
        next[d] += side;
        if (!taken(next)) return true;
      }
    return false;
  };
  int near = 0, cells = 0;
  for_each_index(box, [&](const IndexVec<Dim>& at) {
    if (!taken(at)) return;
    const IndexVec<Dim> one = IndexVec<Dim>::Constant(1);
    bool expected = false;
    for_each_index(IndexBox<Dim>{at - one, at + 2 * one}, [&](const IndexVec<Dim>& other) {
      expected = expected || !taken(other) || has_open_face(other);
    });
    ASSERT_EQ(near_surface<Dim>(at, [&](const auto& where) { return bool(taken(where)); }),
              expected);
    near += expected;
    ++cells;
  });
  EXPECT_GT(near, cells / 5);
  EXPECT_LT(near, cells * 4 / 5);
}

TEST(NearSurface, IsToHaveAnOpenFaceOrToTouchWhatHas)
{
  expect_near_surfaces<2>();
  expect_near_surfaces<3>();
}

}  // namespace
}  // namespace mpm
