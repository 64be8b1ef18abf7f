#pragma once
/// The explicit step with weights in the reference configuration: cells are locations of the
/// lattice, which share nodes where they were neighbours at the start and only there.

#include <mpm/lagrangian/location_cells.hpp>
#include <mpm/lagrangian/occupants.hpp>
#include <mpm/lagrangian/rest_cell.hpp>
#include <mpm/lagrangian/rigid_cells.hpp>
#include <mpm/lagrangian/self_contact.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/stepping/formulation.hpp>
#include <mpm/stepping/loss.hpp>

#include <memory>

namespace mpm {

/// Central differences: velocities stand half a step before places and stresses. Places and
/// velocities live on the nodes. There is no sort, no migration and no activity; the halo changes
/// only where borders between ranks move, and a step has no collective. Cells that fail leave their
/// mass on the nodes.
template <int Dim>
class TotalLagrangian final : public Formulation<Dim> {
 public:
  struct Setup {
    /// Particles at the centres of their locations, in the order of their ids.
    std::vector<Body<Dim>> bodies;
    Slots<Dim> slots{};
    Vec<Dim> location_size;  ///< m
    double thickness = 1;    ///< m, of the plane
    /// kappa: across a flush face the pressure of contact is 2 kappa C times the depth over the
    /// size of a location. 0: bodies go through each other.
    double contact_stiffness = 2;
    BodyPairs pairs{};  ///< of all bodies, rigid ones last
    /// Cells with a smaller least stretch are made heavier by the square of this over it, so that
    /// they do not shorten the step. 0: none.
    double mass_scaling = 0.8;
    /// At rest the corners stand so beside the lattice; those of this rank's cells at least. In the
    /// plane only.
    CornerOffsets<Dim> offsets{};
    std::vector<RigidCells<Dim>> rigid{};  ///< the same ones on every rank
    std::vector<FailureLimits> failure{};  ///< of each body; empty: no cell fails
    /// s, of all steps that will be asked for: contact looks ahead as far as nodes may go in it.
    double longest_step = 0;
  };

  TotalLagrangian(Decomposition<Dim> decomposition, Setup setup);

  void step(double dt) override;
  void check() override;
  const Agreed& agreed() const override { return agreed_; }

  double time() const override { return time_; }
  double kicked_time() const override { return kicked_time_; }
  GlobalIndex steps() const override { return steps_; }
  const std::vector<Body<Dim>>& bodies() const override;
  const Decomposition<Dim>& decomposition() const override { return decomposition_; }
  LocalIndex active_nodes() const override { return nodes_->size(); }
  Carried<Dim> carried() const override;
  bool has_friction() override;
  Reaction<Dim> take_reaction() override { return given_.take(); }
  double stress_moment() const override { return 0.5; }
  Slots<Dim>& slots() override { return setup_.slots; }
  double largest_step() const override { return setup_.slots.largest_step(); }

  /// After a check, which leaves nothing to be counted.
  bool can_repartition() const override { return checked_ == steps_; }
  GlobalIndex repartition(const Ownership<Dim>& ownership) override;
  void visit_work(const std::function<void(const IndexVec<Dim>&, double)>& visit) const override;

  Counters counters() const override;
  std::size_t bytes() const override;
  void archive(Archive& archive) override;
  void begin_loading(const Ownership<Dim>& ownership) override;

 private:
  using CellNodes = typename LocationCells<Dim>::CellNodes;
  using ContactCells = typename SelfContact<Dim>::Cells;
  using Formulation<Dim>::steps_between_checks;

  void make_mesh();
  void take_rest();
  void take_rigid_bodies(std::span<const CellNodes> cells);
  /// As contact sees a cell at rest.
  struct CellForm {
    std::optional<CellOutline> outline;
    double volume;  ///< m^3, in the plane m^2
  };
  CellForm form_of(const CellNodes& nodes) const;
  ContactCells contact_cells(const Occupants<Dim>& occupants) const;
  void list_node_terms();
  void add_masses();
  void give_rigid_mass();
  void add_forces(double dt);
  void gather_cell_forces();
  void book_friction(double dt);
  void lead_rigid_bodies(double dt);
  void add_loads_on_particles();
  void add_load(const Load<Dim>& load, std::size_t body);
  double time_to_next_check() const;
  double way_to_next_check() const;
  std::vector<double> ways_to_next_check() const;
  void find_pairs();
  void renew_pairs();
  void scale_masses();
  bool cells_may_fail() const { return !setup_.failure.empty(); }
  std::vector<double> remove_failed();
  void remove(std::size_t body, std::span<const LocalIndex> cells);
  void part(std::span<const double> failed_locations);
  void list_what_is_left();
  void archive_failure(Archive& archive);
  void archive_removed(Archive& archive);
  void archive_cells(Archive& archive, std::size_t number);
  IndexVec<Dim> location_of(const Body<Dim>& body, LocalIndex particle) const;
  RestCell<Dim> rest_of(std::size_t body, LocalIndex cell) const;
  IndexVec<Dim> location_of_cell(std::size_t body, LocalIndex cell) const;
  IndexVec<Dim> grid_cell_of(const IndexVec<Dim>& location) const;
  GlobalIndex take_cells(const Ownership<Dim>& ownership);
  IndexVec<Dim> period() const;
  /// Whether no cell that can be deformed has a node.
  bool is_rigid(LocalIndex node) const { return first_masses_[std::size_t(node)] == 0; }
  std::span<const NodeRun<Dim>> runs() const { return {&run_, 1}; }

  Decomposition<Dim> decomposition_;
  /// Its particles' places and velocities follow the nodes when they are asked for.
  mutable Setup setup_;
  mutable bool particles_are_present_ = true;
  bool fitted_;  ///< whether corners stand beside the lattice at rest, on any rank

  std::optional<MeshNodes<Dim>> nodes_;
  std::optional<NodeFields<Dim>> fields_;
  std::optional<Halo> halo_;
  NodeRun<Dim> run_;
  std::vector<LocationCells<Dim>> cells_;            ///< of each body
  std::vector<LaneVector<double>> least_stretches_;  ///< squared, of their cells at the last check
  // In the plane, where nodes gather what cells do to them.
  std::vector<std::size_t> first_force_;
  LaneVector<double> cell_forces_;  ///< all bodies' blocks, and a row of zeros
  /// [nodes * corners]: where in cell_forces_ the row of a cell around it stands.
  std::vector<std::int32_t> node_terms_;
  std::unique_ptr<SelfContact<Dim>> contact_;
  std::vector<double> friction_;  ///< [nodes * Dim], N; empty without
  double friction_work_ = 0;      ///< J, of this rank's nodes since the start

  std::vector<double> first_masses_;          ///< kg, of the nodes, without `rigid_mass_`
  std::vector<CellNodes> rigid_cells_;        ///< of all rigid bodies in turn
  std::vector<std::vector<LocalIndex>> led_;  ///< nodes of each rigid body
  /// kg, of nodes that rigid bodies alone have: so much that friction knows that they do not give
  /// way. It counts nowhere else. 0 without such bodies.
  double rigid_mass_ = 0;
  /// By masses that come and go, by friction and by rigid bodies; to this rank's nodes.
  Reaction<Dim> given_;

  Counters earlier_;          ///< of runs that this one goes on with
  FailedCells failed_;        ///< of this rank
  Occupants<Dim> occupants_;  ///< where cells may fail
  /// Those that have failed here: their nodes hold together what they did not part.
  std::vector<RestCell<Dim>> removed_;

  double time_ = 0, kicked_time_ = 0, last_step_ = 0;
  GlobalIndex steps_ = 0;
  Agreed agreed_;
  GlobalIndex checked_ = 0;
  double largest_speed_ = 0;  ///< m/s, of a node since the last check
  double fastest_ = 0;        ///< the same of all ranks up to then, or at the start
  std::optional<Loss<Dim>> loss_;
};

}  // namespace mpm
