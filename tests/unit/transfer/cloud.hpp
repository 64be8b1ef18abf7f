#pragma once
/// Random particles on a grid with another spacing along each axis, and the same ones for the naive
/// formulae.

#include <random>

#include "naive_transfer.hpp"
#include "node_grid.hpp"
#include <gmock/gmock.h>

namespace mpm {

struct TransferCase {
  OneOf<ShapeRow> shape;
  OneOf<SchemeRow> scheme;
};

/// Every shape with every scheme.
class TransferTest : public testing::TestWithParam<std::tuple<OneOf<ShapeRow>, OneOf<SchemeRow>>> {
 protected:
  TransferCase parameters() const { return {std::get<0>(GetParam()), std::get<1>(GetParam())}; }
};

inline std::string case_name(const testing::TestParamInfo<TransferTest::ParamType>& info)
{
  return std::string(std::get<0>(info.param)->keyword) + "_" +
         std::string(std::get<1>(info.param)->keyword);
}

/// Positions carry a relative rounding of 10 epsilon after the division by h; some tens of terms
/// of the size that the comparison is scaled with are added.
inline constexpr double rounding = 1e-12;

template <int Dim>
struct Cloud {
  static constexpr int particles_per_cell = Dim == 2 ? 2 : 3;  // half sizes 1/4 and 1/6
  static constexpr int count = 61;                             // fills no lanes evenly

  TransferCase parameters;
  std::unique_ptr<Transfer<Dim>> transfer;
  NodeGrid<Dim> grid;
  Body<Dim> body;
  NaiveTransfer<Dim> naive;
  typename NaiveTransfer<Dim>::Particles particles;
  typename NaiveTransfer<Dim>::Nodes nodes;
  std::mt19937 random{5};

  explicit Cloud(TransferCase c, bool musl = false, bool f_bar = false, double pic_share = 0)
      : parameters(c),
        transfer(
            make_transfer<Dim>(c.shape, c.scheme, {1.0 / particles_per_cell, pic_share, f_bar})),
        grid(geometry(), local(), local(), 0),
        body{"cloud", 0, 1.0, std::make_unique<RecordingLaw<Dim>>(), store(musl)},
        naive{{c.shape, 0.5 / particles_per_cell}, c.scheme, geometry().spacing}
  {
    for (LocalIndex node = 0; node < grid.topology.size(); ++node) {
      grid.topology.touch(node);
      NaiveNode<Dim> naive_node;
      for (int d = 0; d < Dim; ++d)
        naive_node.x[d] = grid.topology.geometry().node_position(
            d, local().lower[d] + node / grid.topology.stride(d) % local().count()[d]);
      nodes.push_back(naive_node);
    }
    grid.end_activity(transfer->support());
    for (int p = 0; p < count; ++p) particles.push_back(random_particle());
    fill_body();
  }

  /// In [-1, 1], different at each call.
  double number() { return std::uniform_real_distribution(-1.0, 1.0)(random); }
  template <int Rows, int Columns>
  Eigen::Matrix<double, Rows, Columns> numbers()
  {
    return Eigen::Matrix<double, Rows, Columns>::NullaryExpr([&] { return number(); });
  }

  static Vec<Dim> lower_corner()  ///< of the cell in the middle, which all particles are around
  {
    return geometry().origin +
           (geometry().spacing.array() * (local().lower.array() + 3).template cast<double>())
               .matrix();
  }

  /// Puts `particles` into the columns, in their order.
  void fill_body()
  {
    body.particles = store(body.particles.motion().find("grid_velocity") >= 0);
    for (const NaiveParticle<Dim>& p : particles) {
      const LocalIndex at = body.particles.add(1000 + body.particles.size());
      ColumnGroup &motion = body.particles.motion(), &state = body.particles.state();
      for (int d = 0; d < Dim; ++d) {
        motion(d, at) = p.x[d];
        motion(Dim + d, at) = p.v[d];
      }
      motion(2 * Dim, at) = p.mass;
      for (int k = 0; naive.affine() && k < Dim * Dim; ++k)
        motion(2 * Dim + 1 + k, at) = p.affine(k % Dim, k / Dim);
      const int domain = motion.find("domain");
      for (int k = 0; domain >= 0 && k < Dim * Dim; ++k)
        motion(domain + k, at) = p.domain(k % Dim, k / Dim);
      state(0, at) = p.volume;
      for (int c = 0; c < RecordingLaw<Dim>::components; ++c) {
        const auto [i, j] = RecordingLaw<Dim>::place(c);
        state(1 + c, at) = p.stress(i, j);
      }
    }
    body.particles.seal();
  }

  /// Gives the nodes' updated and gradient velocities, the same to both.
  template <class Field>
  void set_velocities(Field field)
  {
    for (LocalIndex node = 0; node < grid.topology.size(); ++node) {
      NaiveNode<Dim>& n = nodes[node];
      field(n);
      for (int d = 0; d < Dim; ++d) {
        grid.fields.updated_of(node)[d] = n.velocity[d];
        grid.fields.updated_of(node)[Dim + d] = n.increment[d];
        grid.fields.set_gradient_velocity(node, d, n.gradient_velocity[d]);
      }
    }
  }
  void set_random_velocities()
  {
    set_velocities([&](NaiveNode<Dim>& n) {
      n.velocity = numbers<Dim, 1>();
      n.increment = numbers<Dim, 1>();
      n.gradient_velocity = numbers<Dim, 1>();
    });
  }

  MoveBounds<Dim> wide_bounds() const
  {
    const Vec<Dim> far = Vec<Dim>::Constant(1e9);
    return {-far, far};
  }

  static GridGeometry<Dim> geometry()
  {
    return {Vec<3>(-2.0, 1.0, 0.3).head<Dim>(), Vec<3>(0.5, 0.3, 0.4).head<Dim>(),
            IndexVec<Dim>::Constant(30)};
  }
  static IndexBox<Dim> local()
  {
    const IndexVec<Dim> lower = IndexVec<3>(4, 6, 5).head<Dim>();
    return {lower, lower + IndexVec<3>(9, 8, 7).head<Dim>()};
  }

 private:
  /// Sheared and stretched, some beyond what weights see of them, some without volume.
  Matrix<Dim> random_domain()
  {
    const Matrix<Dim> rest = naive.shape.l * Matrix<Dim>(geometry().spacing.asDiagonal());
    const Matrix<Dim> stretch = Matrix<Dim>::Identity() + 0.4 * numbers<Dim, Dim>();
    const std::size_t k = particles.size();
    if (k == 7) return Matrix<Dim>::Zero();
    if (k == 8) return rest.colwise().reverse();  // inside out
    return (k % 4 == 0 ? 6 : k % 4 == 1 ? 0.2 : 1) * stretch * rest;
  }
  ParticleStore store(bool musl) const
  {
    return {transfer->motion_columns(musl),
            RecordingLaw<Dim>{}.state_columns(),
            {"mass", "initial_volume"}};
  }
  NaiveParticle<Dim> random_particle()
  {
    NaiveParticle<Dim> p;
    for (int d = 0; d < Dim; ++d)
      p.x[d] = lower_corner()[d] + geometry().spacing[d] * (0.5 + 0.9 * number());
    p.v = numbers<Dim, 1>();
    p.mass = 1.5 + number();
    p.volume = 1.5 + number();
    if (naive.affine()) p.affine = numbers<Dim, Dim>();
    if (naive.has_domain()) p.domain = random_domain();
    const Matrix<Dim> a = numbers<Dim, Dim>();
    p.stress = a + a.transpose();
    return p;
  }
};

}  // namespace mpm
