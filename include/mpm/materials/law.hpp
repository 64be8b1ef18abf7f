#pragma once
/// What a material law offers to the step: it updates blocks of particles and knows nothing of
/// shape functions, schemes or grids.

#include <mpm/core/lanes.hpp>
#include <mpm/core/types.hpp>
#include <mpm/materials/bending.hpp>
#include <mpm/particles/particle_store.hpp>

#include <memory>
#include <string>
#include <vector>

namespace mpm {

/// Independent components of a symmetric tensor in the plane or in space: xx, yy, xy in 2D;
/// xx, yy, zz, xy, yz, xz in 3D.
template <int Dim>
inline constexpr int symmetric_components = Dim*(Dim + 1) / 2;

/// State blocks, one behind the other, as ColumnGroup lays them out. One virtual call serves many
/// particles. Stresses are Kirchhoff stresses tau = J sigma, so that with V0 the reference volume
/// the internal force on a node is - sum V0 tau g (docs/theory.md).
template <int Dim>
class Law {
 public:
  virtual ~Law() = default;

  /// State columns; the first is always `initial_volume` (m^3).
  virtual std::vector<Column> state_columns() const = 0;
  /// Fills the state of a stress-free particle (`initial_volume` is set by the caller).
  virtual void initialise(ColumnGroup& state, LocalIndex particle) const = 0;

  /// One step: state and stress from the velocity gradient. `gradient` holds per block Dim * Dim
  /// columns of lanes, dv_i/dx_j at i + Dim * j, 1/s; `force_stress` receives V0 tau per block,
  /// symmetric_components columns of lanes, J.
  virtual void update(double* state, int blocks, const double* gradient, double dt,
                      double* force_stress) const = 0;
  virtual BendingModuli<Dim> bending_moduli() const { return {}; }
  /// The same as `update` for a cell that also bends; `bending` as in bending.hpp.
  virtual void update_bent(double* state, int blocks, const double* gradient, double dt,
                           double* force_stress, double* bending) const
  {
    update(state, blocks, gradient, dt, force_stress);
    for (int k = 0; k < blocks; ++k)
      take_no_moments<Dim>(bending + k * bending_columns<Dim> * lane_count);
  }
  /// V0 tau of the present state, without changing it.
  virtual void force_stress(const double* state, int blocks, double* force_stress) const = 0;

  /// Cauchy stress of one block: columns xx, yy, zz, xy, yz, xz, Pa.
  virtual void cauchy_stress(const double* state, double* stress) const = 0;
  /// Elastic energy of one block, J per particle.
  virtual Lanes elastic_energy(const double* state) const = 0;
  /// J, by which tau = J sigma, of one block; lanes of padding may hold anything.
  virtual Lanes volume_ratio(const double* state) const = 0;

  /// Speed of the fastest wave in the undeformed material, m/s.
  virtual double wave_speed() const = 0;
  /// Square of the speed of the fastest wave in the particles of one block as they are now, or an
  /// upper bound, m^2/s^2; lanes of padding may hold anything.
  virtual Lanes fastest_wave_squared(const double* state) const = 0;
};

}  // namespace mpm
