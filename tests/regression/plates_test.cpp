// Two plates of cells, two thick, at any angle to the lattice, are driven against each other: they
// turn back where their faces meet, or the teeth of their stairs.
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "whole_scene.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace mpm {
namespace {

constexpr double location = 0.5e-3, length = 50 * location, thickness = 2 * location;
constexpr double density = 1000, wave = 1160.24;  ///< kg/m^3; m/s, of the fastest

struct Meeting {
  double angle;  ///< of the plates to the lattice, degrees
  double apart;  ///< at the start, in locations
  double slide;  ///< speed along the faces over that across them
  const char* surface;
  double speed = 0.01;  ///< of either, of the fastest wave's
  double cfl = 0.49;
};

/// A rectangle along the faces with its lower side at `height` above the middle of the scene, m.
std::string plate(const Meeting& meeting, double height, double across, const char* name)
{
  const double angle = meeting.angle * std::numbers::pi / 180, half = 0.5 * length;
  const Vec<2> along(std::cos(angle), std::sin(angle)), up(-along[1], along[0]);
  std::string corners;
  for (const auto& [x, y] : {std::pair{-half, height},
                             {half, height},
                             {half, height + thickness},
                             {-half, height + thickness}}) {
    const Vec<2> at = Vec<2>::Constant(40 * location) + x * along + y * up;
    corners += fmt::format("{}[{} m, {} m]", corners.empty() ? "" : ", ", at[0], at[1]);
  }
  const Vec<2> velocity = across * (up + meeting.slide * along);
  return fmt::format(
      "    - {{polygon: {{vertices: [{}]}}, material: {}, velocity: [{} m/s, {} m/s]}}\n", corners,
      name, velocity[0], velocity[1]);
}

std::string text_of(const Meeting& meeting)
{
  const double speed = meeting.speed * wave;
  const double half = 0.5 * meeting.apart * location;
  std::string text = "materials:\n";
  for (const char* name : {"lower", "upper"})
    text += fmt::format(
        "  - {{name: {}, law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0.3, "
        "density: 1000 kg/m^3}}\n",
        name);
  text += fmt::format("specimen:\n  size: [{0} m, {0} m]\n  shapes:\n", 80 * location);
  text += plate(meeting, -half - thickness, speed, "lower") + plate(meeting, half, -speed, "upper");
  return text +
         fmt::format(
             "grid: {{cells: [40, 40]}}\nnumerics: {{formulation: total_lagrangian, "
             "surface: {}, cfl: {}}}\nfree_motion: {{end_time: 1 ms}}\noutput: {{snapshots: 0}}\n",
             meeting.surface, meeting.cfl);
}

/// Mean places across and areas of the two plates.
struct Faces {
  std::array<double, 2> place{}, area{};

  Faces(const Formulation<2>& formulation, double angle)
  {
    const Vec<2> up(-std::sin(angle), std::cos(angle));
    for (std::size_t b = 0; b < 2; ++b) {
      const ParticleStore& particles = formulation.bodies()[b].particles;
      const int mass = particles.motion().find("mass");
      for (LocalIndex p = 0; p < particles.size(); ++p) {
        const double m = particles.motion()(mass, p);
        area[b] += m / density;
        place[b] +=
            m / density * up.dot(Vec<2>(particles.motion()(0, p), particles.motion()(1, p)));
      }
      place[b] /= area[b];
    }
  }
  /// Between the mean faces, in locations.
  double gap() const
  {
    return (place[1] - place[0] - 0.5 * (area[0] + area[1]) / length) / location;
  }
};

class Flight {
 public:
  explicit Flight(const Meeting& meeting)
      : scene_(scene_of(text_of(meeting))),
        preparation_(MPI_COMM_WORLD, scene_, std::nullopt),
        decomposition_(MPI_COMM_WORLD, preparation_.partition.ownership),
        formulation_(make_formulation(
            scene_, preparation_.layout, decomposition_,
            make_model(scene_, preparation_.specimen, preparation_.layout, decomposition_))),
        time_step_(time_step_of(preparation_.layout))
  {
  }
  void advance(int steps)
  {
    for (int k = 0; k < steps; ++k) formulation_->step(time_step_.next(*formulation_));
  }
  const Formulation<2>& formulation() const { return *formulation_; }

 private:
  scene::Scene scene_;
  Preparation<2> preparation_;
  Decomposition<2> decomposition_;
  std::unique_ptr<Formulation<2>> formulation_;
  TimeStep time_step_;
};

/// The smallest gap at any time.
double closest(const Meeting& meeting)
{
  Flight flight(meeting);
  const double angle = meeting.angle * std::numbers::pi / 180;
  double gap = Faces(flight.formulation(), angle).gap(), before = gap;
  for (bool approach = true; approach;) {
    flight.advance(5);
    const double now = Faces(flight.formulation(), angle).gap();
    approach = now < before;
    gap = std::min(gap, now);
    before = now;
  }
  return gap;
}

/// Less the depth, 1 % of the fastest wave's speed brings them 0.01 to 0.03 into each other.
constexpr double depth = 0.03;

TEST(Plates, AlongTheLatticeTurnBackWhereTheirFacesMeet)
{
  for (const char* surface : {"stairs", "fitted"})
    for (const double apart : {2.5, 3.3})
      for (const double slide : {0.0, 0.3}) {
        const double gap = closest({0, apart, slide, surface});
        EXPECT_LT(gap, 0) << surface << ", " << apart << ", " << slide;
        EXPECT_GT(gap, -depth) << surface << ", " << apart << ", " << slide;
      }
}

/// Stairs have teeth as high as half the diagonal that a location has across the face, and two
/// plates meet with their tips where these come to lie on each other.
/// They would be most of a location within each other before cells are looked at for the first time
/// in the usual turn.
TEST(Plates, ThatFlyFastAreSeenBeforeTheyMeet)
{
  for (const char* surface : {"stairs", "fitted"}) {
    Flight flight({0, 1, 0, surface, 0.1, 0.25});
    const double before = flight.formulation().carried().kinetic_energy;
    flight.advance(300);
    const double after = flight.formulation().carried().kinetic_energy;
    EXPECT_LT(after, 1.03 * before) << surface;
    EXPECT_GT(after, 0.5 * before) << surface;
    EXPECT_GT(Faces(flight.formulation(), 0).gap(), 1) << surface;
  }
}

TEST(Plates, AcrossTheLatticeTurnBackWhereTheTeethOfTheirStairsMeet)
{
  for (const double angle : {15.0, 30.0, 45.0}) {
    const double radians = angle * std::numbers::pi / 180;
    double mean = 0;
    for (const double apart : {2.5, 2.9, 3.3, 3.7})
      for (const double slide : {0.0, 0.3}) {
        const double gap = closest({angle, apart, slide, "stairs"});
        EXPECT_GT(gap, -depth) << angle << ", " << apart;
        EXPECT_LT(gap, std::sin(radians) + std::cos(radians)) << angle << ", " << apart;
        mean += gap / 8;
      }
    std::printf("%g degrees: mean gap %.2f with stairs\n", angle, mean);
    EXPECT_GT(mean, 0.2) << angle;
  }
}

/// Teeth are left where fitted corners stand, 0.24 of a location to either side. Contact sees two
/// fifths of what is beyond the face; what is short of it lets the tips of teeth in.
TEST(Plates, AcrossTheLatticeTurnBackWhereTheirFacesMeetIfTheyAreFitted)
{
  for (const double angle : {15.0, 30.0, 45.0}) {
    double mean = 0;
    for (const double apart : {2.5, 2.9, 3.3, 3.7})
      for (const double slide : {0.0, 0.3}) {
        const double gap = closest({angle, apart, slide, "fitted"});
        EXPECT_GT(gap, -0.13) << angle << ", " << apart << ", " << slide;
        EXPECT_LT(gap, 0.1) << angle << ", " << apart << ", " << slide;
        mean += gap / 8;
      }
    std::printf("%g degrees: mean gap %.2f fitted\n", angle, mean);
    EXPECT_GT(mean, -0.03) << angle;
    EXPECT_LT(mean, 0.06) << angle;
  }
}

}  // namespace
}  // namespace mpm
