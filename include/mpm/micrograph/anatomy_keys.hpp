#pragma once
/// The keys of a parameter file, section by section.

#include <mpm/micrograph/anatomy_parameters.hpp>

#include <string_view>
#include <variant>

namespace mpm::micrograph::anatomy {

/// Everything there is to know about one key: the reader, the messages and the manual use it.
template <class T>
struct Row {
  std::string_view name;
  std::variant<double T::*, int T::*> member;
  double lowest, highest;
  std::string_view unit, help;
};

inline constexpr Row<Picture> picture_rows[] = {
    {"width_px", &Picture::width_px, 16, 20000, "px", "radial size of the picture"},
    {"height_px", &Picture::height_px, 16, 20000, "px", "tangential size of the picture"},
    {"width", &Picture::width, 1, 1e5, "um", "radial size of the wood in the picture"},
    {"height", &Picture::height, 1, 1e5, "um", "tangential size of the wood in the picture"},
};
inline constexpr Row<Gray> gray_rows[] = {
    {"wall", &Gray::wall, 0, 255, "", "gray level of cell walls"},
    {"lumen", &Gray::lumen, 0, 255, "", "gray level deep inside a lumen"},
    {"edge", &Gray::edge, 0, 100, "", "how much brighter a wall is at its rim"},
    {"lamella", &Gray::lamella, 0, 100, "", "how much darker the middle lamella is"},
    {"noise", &Gray::noise, 0, 50, "", "standard deviation of the noise of a pixel"},
    {"shading", &Gray::shading, 0, 50, "", "slow variation over a third of the picture"},
    {"blur", &Gray::blur, 0, 10, "", "passes of a 1-2-1 filter"},
};
inline constexpr Row<Irregularity> irregularity_rows[] = {
    {"position", &Irregularity::position, 0, 0.5, "", "scatter of cell centres / cell size"},
    {"size", &Irregularity::size, 0, 0.3, "", "scatter of cell sizes"},
    {"wall", &Irregularity::wall, 0, 0.3, "", "scatter of wall thickness"},
    {"wave", &Irregularity::wave, 0, 100, "um", "how far files and rays wave"},
    {"wave_length", &Irregularity::wave_length, 10, 1e5, "um", "distance over which they wave"},
    {"rim", &Irregularity::rim, 0, 10, "um", "unevenness of single walls"},
    {"rim_length", &Irregularity::rim_length, 1, 1e3, "um", "distance over which a wall is uneven"},
};
inline constexpr Row<CellKind> cell_rows[] = {
    {"radial_pitch", &CellKind::radial_pitch, 2, 1000, "um",
     "radial size of a cell with its walls"},
    {"wall", &CellKind::wall, 0.1, 100, "um", "wall of one cell, half of the double wall"},
    {"roundness", &CellKind::roundness, 0, 1, "", "of the lumen: 0 angular, 1 round"},
};
inline constexpr Row<Files> files_rows[] = {
    {"tangential_pitch", &Files::tangential_pitch, 2, 1000, "um", "distance of radial files"},
    {"tangential_scatter", &Files::tangential_scatter, 0, 0.3, "", "scatter of that distance"},
    {"stretch", &Files::stretch, 0.5, 3, "",
     "1 hexagons, above 1 bricks; ducts are that much longer"},
};
inline constexpr Row<GrowthRing> ring_rows[] = {
    {"boundary", &GrowthRing::boundary, -1e6, 1e6, "um", "x of an end of a ring"},
    {"width", &GrowthRing::width, 10, 1e6, "um", "radial width of a ring"},
    {"latewood", &GrowthRing::latewood, 0, 1, "", "share of a ring that is latewood"},
    {"transition", &GrowthRing::transition, 1, 1e6, "um", "width of the change to latewood"},
};
inline constexpr Row<Rays> rays_rows[] = {
    {"spacing", &Rays::spacing, 10, 1e5, "um", "mean tangential distance of rays"},
    {"cell_height", &Rays::cell_height, 2, 1000, "um", "tangential size of a ray cell"},
    {"cell_length", &Rays::cell_length, 2, 1e4, "um", "radial size of a ray cell"},
    {"wall", &Rays::wall, 0.1, 100, "um", "wall of one ray cell"},
    {"rows", &Rays::rows, 1, 20, "", "ray cells side by side"},
    {"filled", &Rays::filled, 0, 1, "", "how far ray cells are filled: 0 open lumens, 1 solid"},
};
inline constexpr Row<Vessels> vessels_rows[] = {
    {"per_mm2", &Vessels::per_mm2, 0, 1e4, "1/mm2", "number of vessels"},
    {"smallest", &Vessels::smallest, 2, 1e3, "um", "smallest tangential diameter"},
    {"largest", &Vessels::largest, 2, 1e3, "um", "largest tangential diameter"},
    {"wall", &Vessels::wall, 0.1, 100, "um", "wall of a vessel"},
    {"group_chance", &Vessels::group_chance, 0, 1, "", "chance that one more joins a radial group"},
};
inline constexpr Row<Grain> grain_rows[] = {
    {"cell_length", &Grain::cell_length, 10, 1e6, "um", "length of cells along the grain"},
    {"taper", &Grain::taper, 1, 1e5, "um",
     "way along the grain on which a lumen closes at its end"},
};
inline constexpr Row<ResinCanal> canal_rows[] = {
    {"x", &ResinCanal::x, -1e6, 1e6, "um", "centre, from the left"},
    {"y", &ResinCanal::y, -1e6, 1e6, "um", "centre, from the top"},
    {"diameter", &ResinCanal::diameter, 2, 1e4, "um", "tangential diameter of the canal"},
    {"epithelium", &ResinCanal::epithelium, 2, 1e3, "um", "size of the cells around it"},
    {"wall", &ResinCanal::wall, 0.1, 100, "um", "wall of the canal and of these cells"},
};
inline constexpr Row<Density> density_rows[] = {
    {"threshold", &Density::threshold, 1, 254, "", "gray level from which a location is wall"},
    {"lattice_x", &Density::lattice_x, 1, 1e5, "", "locations along x on which density is counted"},
    {"lattice_y", &Density::lattice_y, 1, 1e5, "", "locations along y"},
};
inline constexpr Row<DensityWindow> window_rows[] = {
    {"from", &DensityWindow::from, 0, 1, "", "left border / width"},
    {"to", &DensityWindow::to, 0, 1, "", "right border / width"},
    {"relative_density", &DensityWindow::relative_density, 0.01, 0.99, "",
     "wall share that the walls of the window are scaled to"},
};

}  // namespace mpm::micrograph::anatomy
