#pragma once
/// What a picture makes of each location of a section across z, and a stack of slices of each in
/// space.

#include <mpm/micrograph/image.hpp>
#include <mpm/micrograph/picture.hpp>
#include <mpm/micrograph/pieces.hpp>
#include <mpm/micrograph/share.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace mpm::micrograph {

/// How far a relative density may be from the one that is aimed at.
inline constexpr double density_tolerance = 0.005;

/// What was taken from a picture.
struct PictureFigures {
  double threshold = 0;           ///< gray level that parts the pixels; 0 with bands
  double location_threshold = 0;  ///< that parts the mean grays of the locations; 0 with bands
  double density = 0;             ///< share of the pixels that are wall
  double aim = 0;                 ///< relative density that the scene asks for; 0 if it does not
  /// m by which walls were made thicker (below 0: thinner) all around, where no threshold gives the
  /// density aimed at; the thresholds are then levels of the distance picture (grown_walls.hpp).
  double growth = 0;
  std::int64_t removed = 0;      ///< locations removed as specks or unconnected pieces
  std::int64_t unconnected = 0;  ///< locations left in pieces that do not hang on the largest
};

/// Gray levels [from, to) made of one material.
struct Band {
  double from, to;
  std::int8_t material;
};

/// A location belongs to the cell wall, or to a material, by the mean gray of the picture over its
/// rectangle, in space of the stack over its box. Holds the picture, the limits of the gray levels
/// and what was removed, but no lattice.
template <int Dim>
class Section {
 public:
  /// Limits and pieces are found by all parts together, each from its slab of the specimen.
  /// Collective. Throws on all parts or on none InputError (no wall, impossible bands, a stack
  /// whose threshold gives no such density).
  Section(const scene::Scene& scene, Picture picture, const IndexVec<Dim>& count,
          const Share& share);

  const PictureFigures& figures() const { return figures_; }
  /// Materials of the locations of a part, x fastest.
  std::vector<std::int8_t> materials(const IndexBox<Dim>& part) const;
  /// Of each pixel, top row first, the higher the more it is wall: its gray, minus that where walls
  /// are dark, or with bands whether it lies in one.
  std::vector<double> wall_levels() const;
  const GrayImage& image() const { return image_; }

 private:
  struct Parting {
    double threshold;
    double missed;  ///< of the share of wall that it was to part, by more than half a location
  };
  /// The threshold that gives the relative density, in the picture or, where none does, in that of
  /// the distances from its walls' surface, which takes the picture's place (not of a stack).
  /// `means`: of this part's slab, whose materials `held` has room for. Collective.
  double threshold_of_density(double target, const scene::Micrograph& micrograph,
                              const std::array<double, 2>& size, const PieceRules& rules,
                              Lattice<Dim>& held, std::vector<double>& means, const Share& share);
  /// The threshold whose walls, less the pieces that the rules remove, are nearest to `target`.
  /// Collective.
  Parting parting_that_leaves(double target, const PieceRules& rules, scene::Wall wall,
                              Lattice<Dim>& held, std::span<const double> means,
                              const Share& share) const;
  /// `held`: this part's slab, `filled`: locations of all parts. Collective.
  void remove_pieces(const PieceRules& rules, Lattice<Dim>& held, double filled,
                     const Share& share);
  void leave_out_removed(const IndexBox<Dim>& part, std::vector<std::int8_t>& materials) const;

  GrayImage image_;
  IndexVec<Dim> count_;
  std::vector<Band> pixel_bands_;  ///< of the pixels' grays
  std::vector<Band> bands_;        ///< of the locations' mean grays
  std::vector<Run> removed_;       ///< in the order of their rows
  PictureFigures figures_;
};

extern template class Section<2>;
extern template class Section<3>;

}  // namespace mpm::micrograph
