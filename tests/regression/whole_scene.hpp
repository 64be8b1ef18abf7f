#pragma once
/// A whole scene from its text to what is left of it, on all ranks.

#include <mpm/parallel/session.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/run.hpp>
#include <mpm/transfer/scheme.hpp>

#include <array>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace mpm {

struct Particle {
  Vec<2> start, place, velocity;
  std::array<double, 6> stress;
};

/// The particles at the end of a run, of all ranks; and the times of all steps.
class Witness final : public Observer<2> {
 public:
  explicit Witness(const Preparation<2>& preparation) : preparation_(preparation) {}

  void look(const State& state) override
  {
    times.push_back(state.formulation.time());
    if (state.fraction < 1 - 1e-12) return;
    std::vector<double> own;
    for (const Body<2>& body : state.formulation.bodies())
      for (LocalIndex p = 0; p < body.particles.size(); ++p) append(body, p, own);
    const std::vector<double> all =
        joined_over_ranks(state.formulation.decomposition().comm(), own);
    for (std::size_t k = 0; k < all.size(); k += 12) {
      Particle& particle = particles.emplace_back();
      particle.start = {all[k], all[k + 1]};
      particle.place = {all[k + 2], all[k + 3]};
      particle.velocity = {all[k + 4], all[k + 5]};
      std::copy_n(&all[k + 6], 6, particle.stress.begin());
    }
  }

  void archive(Archive&) override {}

  std::vector<double> times;
  std::vector<Particle> particles;

 private:
  void append(const Body<2>& body, LocalIndex p, std::vector<double>& values) const
  {
    const GlobalIndex id = body.particles.ids()[std::size_t(p)];
    const LocalIndex row = preparation_.specimen.count()[0];
    const Vec<2>& size = preparation_.layout.location_size;
    const ColumnGroup& motion = body.particles.motion();
    values.insert(values.end(),
                  {(double(id % row) + 0.5) * size[0], (double(id / row) + 0.5) * size[1]});
    for (const int column : {LeadingColumns<2>::position, LeadingColumns<2>::velocity})
      for (int d = 0; d < 2; ++d) values.push_back(motion(column + d, p));
    alignas(lane_alignment) double stress[6 * lane_count];
    body.law->cauchy_stress(body.particles.state().block(p / lane_count), stress);
    for (int c = 0; c < 6; ++c) values.push_back(stress[c * lane_count + p % lane_count]);
  }

  const Preparation<2>& preparation_;
};

struct Outcome {
  RunResult result;
  std::vector<double> times;
  std::vector<Particle> particles;
  double end() const { return times.back(); }
  const HistoryLine& last() const { return result.lines.back(); }
};

inline scene::Scene scene_of(const std::string& text)
{
  const auto file =
      std::filesystem::temp_directory_path() / ("loads_test_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << text;
  scene::Scene scene = scene::read_scene(file);
  std::filesystem::remove(file);
  return scene;
}

inline Outcome run_scene(const std::string& text)
{
  const scene::Scene scene = scene_of(text);
  const Preparation<2> preparation(MPI_COMM_WORLD, scene, std::nullopt);
  Witness witness(preparation);
  std::array<Observer<2>*, 1> observers{&witness};
  RunResult result = run<2>(preparation, observers, {});
  return {std::move(result), std::move(witness.times), std::move(witness.particles)};
}

}  // namespace mpm
