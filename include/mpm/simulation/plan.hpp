#pragma once
/// What a run will do and what it leaves out, as data: the text of --check and `plan` in
/// summary.json are made of it.

#include <mpm/grid/node_columns.hpp>
#include <mpm/output/summary.hpp>
#include <mpm/parallel/ownership.hpp>
#include <mpm/simulation/layout.hpp>
#include <mpm/stepping/step_outline.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mpm {

template <int Dim>
struct Preparation;

/// Bytes are of memory, and of the arrays of particles and nodes. What the sorting of particles and
/// messages take beside them is not in them.
struct Plan {
  struct ParticleColumn {
    std::string name;
    int bytes;  ///< of one particle
  };
  /// A body, and what its particles carry.
  struct Particles {
    std::string body;
    double count;       ///< on all ranks
    double wave_speed;  ///< m/s
    double density;     ///< kg/m3
    std::vector<ParticleColumn> columns;
    int bytes() const;  ///< of one particle
  };
  /// Of a grid: of the boxes of nodes that the ranks hold at the start. A box takes in all cells of
  /// its rank and what stencils reach from them, whether there are particles or not: this is the
  /// bound for nodes in empty regions. Only nodes from `below` to `above` a particle's cell, and
  /// those shared between ranks with the ones next to them, are cleared, updated and looked at.
  /// Of a mesh: there are those at corners of cells and no others.
  struct Nodes {
    double in_grid;                     ///< or corners of the lattice
    double allocated;                   ///< by all ranks
    double largest_rank;                ///< by the rank with most
    std::optional<StencilReach> reach;  ///< of a grid
    std::vector<NodeBytes> columns;
    int bytes() const;  ///< of one node
  };
  /// What the scene does not need, so that there is no memory, pass, message or file for it.
  struct LeftOut {
    std::string what, why;
  };

  std::vector<std::string> method;  ///< shape function, scheme, update order, plane or space
  std::vector<Particles> bodies;    ///< load cell last
  Nodes nodes;
  double contact_cells = 0;             ///< cells that may meet others: those near a surface
  double hinges = 0;                    ///< nodes at which cells hang together by a corner alone
  std::vector<PassOutline> passes;      ///< of a step, over the particles
  std::vector<std::string> conditions;  ///< what holds nodes
  std::vector<std::string> loads;
  /// Sent in a step by the rank that sends most; without particles that go to another rank, and
  /// without what cells in contact tell each other.
  double messages_per_step, bytes_per_step;
  std::vector<LeftOut> left_out;
  double time_step;  ///< s, the first
  double steps;      ///< at least, unless the scene ends the run by their number
  double end_time;   ///< s

  double particles() const;        ///< of all bodies
  int bytes_per_particle() const;  ///< of the body that takes most
  double bytes() const;            ///< of particles and nodes of all ranks
};

/// Collective.
template <int Dim>
Plan make_plan(const Preparation<Dim>& preparation);

/// What the scene does not need, with the reasons; the other parts of the plan are there.
template <int Dim>
std::vector<Plan::LeftOut> left_out(const Preparation<Dim>& preparation, const Plan& plan);

/// The part of summary.json.
void describe(const Plan& plan, output::Summary& summary);

}  // namespace mpm
