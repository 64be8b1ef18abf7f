#include <mpm/core/error.hpp>
#include <mpm/core/memory_archive.hpp>
#include <mpm/particles/particle_store.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <gmock/gmock.h>

namespace mpm {
namespace {

ParticleStore empty_store()
{
  return {{{"position", 2, "m"}, {"velocity", 2, "m/s"}, {"mass", 1, "kg"}},
          {{"initial_volume", 1, "m3"}, {"stress", 3, "Pa"}},
          {"mass", "initial_volume"}};
}

constexpr int motion_width = 5, state_width = 4;

std::vector<double> values_of(const ParticleStore& store, LocalIndex particle)
{
  std::vector<double> values;
  for (int c = 0; c < motion_width; ++c) values.push_back(store.motion()(c, particle));
  for (int c = 0; c < state_width; ++c) values.push_back(store.state()(c, particle));
  return values;
}

/// The same particles without lanes, blocks or columns.
using Model = std::map<GlobalIndex, std::vector<double>>;

Model read(const ParticleStore& store)
{
  Model model;
  for (LocalIndex p = 0; p < store.size(); ++p) model[store.ids()[p]] = values_of(store, p);
  return model;
}

/// Adds particles with values that are all different; `model` gets the same ones.
void add_particles(ParticleStore& store, Model& model, int count, GlobalIndex& next_id)
{
  for (int k = 0; k < count; ++k) {
    const GlobalIndex id = next_id++;
    const LocalIndex p = store.add(id);
    for (int c = 0; c < motion_width; ++c) store.motion()(c, p) = 100.0 * double(id) + c;
    for (int c = 0; c < state_width; ++c) store.state()(c, p) = -100.0 * double(id) - c;
    model[id] = values_of(store, p);
  }
  store.seal();
}

void expect_padding_without_mass_beside_a_real_particle(const ParticleStore& store)
{
  for (LocalIndex lane = store.size(); lane < store.blocks() * lane_count; ++lane) {
    EXPECT_EQ(store.motion()(4, lane), 0) << "mass";
    EXPECT_EQ(store.state()(0, lane), 0) << "initial volume";
    EXPECT_EQ(store.motion()(0, lane), store.motion()(0, store.size() - 1)) << "position";
    EXPECT_EQ(store.state()(3, lane), store.state()(3, store.size() - 1)) << "stress";
  }
}

TEST(ColumnGroup, FindsTheFirstOfAFieldsColumns)
{
  const ParticleStore store = empty_store();
  EXPECT_EQ(store.motion().width(), motion_width);
  EXPECT_EQ(store.motion().find("position"), 0);
  EXPECT_EQ(store.motion().find("mass"), 4);
  EXPECT_EQ(store.state().find("stress"), 1);
  EXPECT_EQ(store.state().find("mass"), -1);
}

TEST(ColumnGroup, KeepsTheParticlesOfABlockSideBySideInEachColumn)
{
  ParticleStore store = empty_store();
  Model model;
  GlobalIndex next_id = 0;
  add_particles(store, model, 2 * lane_count, next_id);
  for (LocalIndex p = 0; p < store.size(); ++p) {
    const double* block = store.motion().block(p / lane_count);
    EXPECT_EQ(block[3 * lane_count + p % lane_count], 100.0 * p + 3);
    EXPECT_EQ(std::uintptr_t(block) % alignof(Lanes), 0u);
  }
}

TEST(ParticleStore, NewParticlesStartFromZeroAlsoWhereErasedOnesWere)
{
  ParticleStore store = empty_store();
  Model model;
  GlobalIndex next_id = 1;
  add_particles(store, model, 5, next_id);
  const std::vector<LocalIndex> all{0, 1, 2, 3, 4};
  store.erase(all);
  EXPECT_EQ(store.size(), 0);
  EXPECT_EQ(store.blocks(), 0);
  store.add(77);
  EXPECT_THAT(values_of(store, 0), testing::Each(0.0));
  EXPECT_THAT(store.ids(), testing::ElementsAre(77));
}

TEST(ParticleStore, PaddingLanesCarryNoMassForAnyCount)
{
  for (int count = 1; count <= 3 * lane_count; ++count) {
    ParticleStore store = empty_store();
    Model model;
    GlobalIndex next_id = 1;
    add_particles(store, model, count, next_id);
    EXPECT_EQ(store.size(), count);
    EXPECT_EQ(store.blocks(), (count + lane_count - 1) / lane_count);
    expect_padding_without_mass_beside_a_real_particle(store);
    EXPECT_EQ(read(store), model);
  }
}

TEST(ParticleStore, APackedParticleArrivesWithItsIdAndAllItsColumns)
{
  ParticleStore sender = empty_store(), receiver = empty_store();
  Model model, there;
  GlobalIndex next_id = (GlobalIndex(1) << 53) + 1;  // more digits than a double has
  add_particles(sender, model, 7, next_id);
  std::vector<double> buffer;
  for (const LocalIndex p : {5, 2}) sender.pack(p, buffer);
  EXPECT_EQ(int(buffer.size()), 2 * sender.packed_size());
  receiver.unpack(buffer);
  EXPECT_THAT(receiver.ids(), testing::ElementsAre(sender.ids()[5], sender.ids()[2]));
  EXPECT_EQ(values_of(receiver, 0), values_of(sender, 5));
  EXPECT_EQ(values_of(receiver, 1), values_of(sender, 2));
}

TEST(ParticleStore, PermutingPutsEveryParticleWithItsIdAtItsNewPlace)
{
  ParticleStore store = empty_store();
  Model model;
  GlobalIndex next_id = 1;
  add_particles(store, model, 3 * lane_count - 1, next_id);
  std::vector<LocalIndex> order(store.size());
  std::iota(order.rbegin(), order.rend(), 0);
  store.permute(order);
  store.seal();
  for (LocalIndex p = 0; p < store.size(); ++p) {
    EXPECT_EQ(store.ids()[p], store.size() - p);
    EXPECT_EQ(values_of(store, p), model[store.ids()[p]]);
  }
}

TEST(ParticleStore, ALongLifeOfRandomChangesLosesNothing)
{
  std::mt19937 random(7);
  const auto below = [&](int bound) { return int(random() % unsigned(bound)); };
  ParticleStore here = empty_store(), there = empty_store();
  Model model_here, model_there;
  GlobalIndex next_id = 1;
  for (int round = 0; round < 400; ++round) {
    add_particles(here, model_here, below(2 * lane_count), next_id);

    std::vector<LocalIndex> order(here.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, random);
    here.permute(order);

    // Some leave for the other store, some for ever.
    std::vector<LocalIndex> gone;
    std::vector<double> buffer;
    for (LocalIndex p = 0; p < here.size(); ++p) {
      const int fate = below(8);
      if (fate > 1) continue;
      const GlobalIndex id = here.ids()[p];
      if (fate == 0) {
        here.pack(p, buffer);
        model_there[id] = model_here[id];
      }
      model_here.erase(id);
      gone.push_back(p);
    }
    here.erase(gone);
    here.seal();
    there.unpack(buffer);
    there.seal();

    ASSERT_EQ(read(here), model_here) << "round " << round;
    ASSERT_EQ(read(there), model_there) << "round " << round;
    expect_padding_without_mass_beside_a_real_particle(here);
    expect_padding_without_mass_beside_a_real_particle(there);
  }
  EXPECT_GT(there.size(), 100);
}

TEST(ParticleStore, ReservedForItsParticlesTakesTheMemoryOfItsColumnsOnly)
{
  constexpr int count = 1100;  // far from a power of two, to which memory would grow by doubling
  ParticleStore store = empty_store();
  store.reserve(count);
  Model model;
  GlobalIndex next_id = 0;
  add_particles(store, model, count, next_id);
  const std::size_t columns =
      std::size_t(store.blocks()) * lane_count * (motion_width + state_width) * sizeof(double);
  EXPECT_EQ(store.bytes(), columns + count * sizeof(GlobalIndex));
  EXPECT_EQ(read(store), model);
}

TEST(ParticleStore, ComesBackFromAnArchiveInItsOrderWithSealedPadding)
{
  for (const int count : {0, 1, lane_count, 2 * lane_count + 3}) {
    ParticleStore store = empty_store(), other = empty_store();
    Model model, others;
    GlobalIndex next_id = 5;
    add_particles(store, model, count, next_id);
    if (count > 1) store.erase(std::vector<LocalIndex>{0});  // ids are no longer in order
    store.seal();
    add_particles(other, others, lane_count + 1, next_id);

    MemoryArchive archive;
    archive.start_saving();
    store.archive(archive);
    archive.start_loading();
    other.archive(archive);
    EXPECT_THAT(archive.unread(), ::testing::IsEmpty());
    EXPECT_THAT(other.ids(), ::testing::ElementsAreArray(store.ids()));
    EXPECT_EQ(read(other), read(store));
    expect_padding_without_mass_beside_a_real_particle(other);
  }
}

TEST(ParticleStore, RefusesAnArchiveWithOtherColumns)
{
  ParticleStore store = empty_store();
  Model model;
  GlobalIndex next_id = 0;
  add_particles(store, model, 3, next_id);
  MemoryArchive archive;
  archive.start_saving();
  store.archive(archive);
  archive.start_loading();
  const auto words_of = [&](ParticleStore other) -> std::string {
    try {
      other.archive(archive);
    } catch (const InputError& error) {
      return error.what();
    }
    return "loaded";
  };
  const std::vector<Column> state{{"initial_volume", 1, "m3"}, {"stress", 3, "Pa"}};
  EXPECT_THAT(words_of({{{"position", 3, "m"}}, state, {}}),
              ::testing::HasSubstr("motion/position has 6 values, not 9"));
  EXPECT_THAT(words_of({{{"position", 2, "m"}, {"affine_velocity", 4, "1/s"}}, state, {}}),
              ::testing::HasSubstr("motion/affine_velocity is not there"));
}

}  // namespace
}  // namespace mpm
