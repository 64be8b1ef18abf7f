#pragma once
/// What the run around it may know of a formulation: one keeps its weights in the present
/// configuration (updated_lagrangian.hpp), another in the reference one (total_lagrangian.hpp).

#include <mpm/core/archive.hpp>
#include <mpm/materials/body.hpp>
#include <mpm/parallel/decomposition.hpp>
#include <mpm/stepping/slots.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace mpm {

/// What the ranks told each other in the last check.
struct Agreed {
  double largest_speed = 0;  ///< m/s, component of a particle's grid velocity in the last step
  double wave_speed = 0;     ///< m/s, of the fastest wave in the particles as they are
  /// Counted work of a step (in particles): of the busiest rank, and the mean.
  double busiest_work = 0, mean_work = 0;
  GlobalIndex most_particles = 0;
  double mean_particles = 0;

  double work_imbalance() const { return mean_work > 0 ? busiest_work / mean_work : 1.0; }
  /// Particles of the fullest rank over the mean.
  double imbalance() const { return mean_particles > 0 ? most_particles / mean_particles : 1.0; }
  void archive(Archive& archive);
};

/// Of this rank since the start.
struct Counters {
  GlobalIndex migrated = 0;  ///< particles that left in a step
  GlobalIndex messages = 0, bytes = 0;
  double waiting_seconds = 0;
  Counters& operator+=(const Counters& other);
  Counters& operator-=(const Counters& other);
  void archive(Archive& archive);
};

/// Cells that failed since the start and what they took along, of this rank.
struct FailedCells {
  GlobalIndex cells = 0, id_sum = 0;
  double mass = 0;          ///< kg, which stays on the nodes
  double energy = 0;        ///< J, that they, and contact with them, had stored
  double plastic_work = 0;  ///< J
};

/// What particles do not carry themselves, on this rank, at present.
template <int Dim>
struct Carried {
  double kinetic_energy = 0;             ///< J
  Vec<Dim> momentum = Vec<Dim>::Zero();  ///< kg m/s
  double elastic_energy = 0;             ///< J, beside that of the particles' laws
  /// kg, by which cells are heavier at present for longer steps; where they may be.
  std::optional<double> added_mass{};
  /// Of the contact of bodies with themselves and others, and with walls that push, where there is
  /// one.
  std::optional<ContactSums> contact{};
  std::optional<FailedCells> failed{};  ///< where cells may fail
};

/// Steps bodies of particles on this rank. All members but the plain look-ups are collective.
template <int Dim>
class Formulation {
 public:
  virtual ~Formulation() = default;

  /// Every `steps_between_checks` steps it ends with `check`.
  virtual void step(double dt) = 0;
  static constexpr GlobalIndex steps_between_checks = 20;
  /// Throws NumericalError on every rank if a particle of any rank was lost, was turned inside out
  /// or stopped being a number since the last check, or has a volume ratio beyond its bounds; what
  /// is measured after that means nothing.
  virtual void check() = 0;
  virtual const Agreed& agreed() const = 0;

  virtual double time() const = 0;  ///< s
  /// s, over which forces have changed velocities: not `time` where these stand between steps.
  virtual double kicked_time() const { return time(); }
  virtual GlobalIndex steps() const = 0;
  /// Their particles as they are now.
  virtual const std::vector<Body<Dim>>& bodies() const = 0;
  virtual LocalIndex active_nodes() const = 0;  ///< of this rank; shared ones count on each
  virtual const Decomposition<Dim>& decomposition() const = 0;

  virtual Carried<Dim> carried() const = 0;
  virtual bool has_friction() { return slots().need_surfaces(); }
  /// What the step itself gave to the bodies since it was last asked: counts as from outside.
  virtual Reaction<Dim> take_reaction() { return {}; }
  /// When a step leaves the stresses, counted from the moment of the velocities, in steps.
  virtual double stress_moment() const = 0;
  /// Loads, contact, conditions and transport.
  virtual Slots<Dim>& slots() = 0;
  /// s, the largest step that these bear.
  virtual double largest_step() const = 0;

  /// Whether cells, and the particles in them, can go to other ranks now. Every rank answers alike.
  virtual bool can_repartition() const = 0;
  /// Returns how many particles this rank sent.
  virtual GlobalIndex repartition(const Ownership<Dim>& ownership) = 0;
  /// visit(cell, work) for all that this rank works on in a step, in particles.
  virtual void visit_work(
      const std::function<void(const IndexVec<Dim>& cell, double work)>& visit) const = 0;

  virtual Counters counters() const = 0;
  virtual std::size_t bytes() const = 0;  ///< of particle and node arrays on this rank
  virtual void archive(Archive& archive) = 0;
  /// Takes up these cells without any particle: `archive` is about to load a state that was saved
  /// on them. Whatever ended the run is forgotten.
  virtual void begin_loading(const Ownership<Dim>& ownership) = 0;

  LocalIndex particles() const
  {
    LocalIndex count = 0;
    for (const Body<Dim>& body : bodies()) count += body.particles.size();
    return count;
  }
};

}  // namespace mpm
