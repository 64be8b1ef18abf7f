#pragma once
/// A brick whose corners are led to places, its forces and energies.

#include <mpm/lagrangian/location_cells.hpp>

#include <optional>

namespace mpm {

/// Columns are corners, m or N.
using BrickPlaces = Eigen::Matrix<double, 3, 8>;

class LedBrick {
 public:
  LedBrick(std::unique_ptr<Law<3>> law, double density, const Vec<3>& size)
      : body_{"brick", 0, density, std::move(law), store_of()},
        nodes_(lattice(), std::vector<char>(8, 1), size, IndexVec<3>::Zero()),
        fields_(8, {.gradient = false}, 0)
  {
    body_.particles =
        ParticleStore(LocationCells<3>::columns(*body_.law), body_.law->state_columns(),
                      {"velocity", "mass", "initial_volume", "plastic_work"});
    body_.particles.add(0);
    body_.particles.state()(0, 0) = size.prod();
    body_.law->initialise(body_.particles.state(), 0);
    LocationCells<3>::initialise(body_.particles.motion(), 0);
    body_.particles.seal();
    const LocationCells<3>::CellNodes corners{0, 1, 2, 3, 4, 5, 6, 7};
    cells_.emplace(body_, std::span(&corners, 1), size);
  }

  BrickPlaces places() const
  {
    BrickPlaces places;
    for (LocalIndex node = 0; node < 8; ++node) places.col(node) = nodes_.position(node);
    return places;
  }
  BrickPlaces force()
  {
    BrickPlaces force;
    for (LocalIndex node = 0; node < 8; ++node)
      force.col(node) = Eigen::Map<const Vec<3>>(fields_.force_of(node));
    return force;
  }
  /// In one step. Returns whether the brick is the right way out.
  bool lead_to(const BrickPlaces& places)
  {
    constexpr double dt = 1e-3;
    const BrickPlaces way = places - this->places(), before = force();
    for (LocalIndex node = 0; node < 8; ++node)
      for (int d = 0; d < 3; ++d) fields_.updated_of(node)[d] = way(d, node) / dt;
    nodes_.move(fields_, dt);
    const bool sound = !cells_->update(body_, nodes_, dt, &fields_);
    work_ -= 0.5 * (before + force()).cwiseProduct(way).sum();
    return sound;
  }
  /// J
  double stored() const
  {
    return cells_->bending_energy(body_, nodes_) +
           body_.law->elastic_energy(body_.particles.state().block(0))[0];
  }
  double dissipated() const
  {
    return body_.particles.state()(body_.particles.state().find("plastic_work"), 0);
  }
  double work() const { return work_; }

 private:
  static ParticleStore store_of() { return {{{"position", 3, "m"}}, {{"volume", 1, "m3"}}, {}}; }
  static std::vector<IndexVec<3>> lattice()
  {
    std::vector<IndexVec<3>> corners;
    for (int c = 0; c < 8; ++c) corners.push_back(LocationMesh<3>::offset_of(c));
    return corners;
  }

  Body<3> body_;
  MeshNodes<3> nodes_;
  NodeFields<3> fields_;
  std::optional<LocationCells<3>> cells_;
  double work_ = 0;
};

}  // namespace mpm
