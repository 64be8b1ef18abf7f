/// Small problems solved with vectors and matrices of the active nodes: nodal values of a field
/// from a consistent mass matrix, and Laplace's equation.

#include <numbers>

#include "active_nodes.hpp"
#include "linear_cell.hpp"
#include <petscksp.h>

namespace mpm {
namespace {

/// Of the residual; errors are larger by the condition number, some hundred on these grids.
constexpr double solver_tolerance = 1e-13, tolerance = 1e-10;

template <int Dim>
using Field = std::function<double(const Vec<Dim>& position)>;

/// x of A x = b by conjugate gradients. Collective.
void solve(const MatrixHandle& matrix, const VectorHandle& right, const VectorHandle& solution)
{
  KSP solver;
  ASSERT_EQ(KSPCreate(MPI_COMM_WORLD, &solver), 0);
  const SolverHandle handle(solver);
  KSPSetOperators(solver, matrix.get(), matrix.get());
  KSPSetType(solver, KSPCG);
  PC jacobi;
  KSPGetPC(solver, &jacobi);
  PCSetType(jacobi, PCJACOBI);
  KSPSetTolerances(solver, solver_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 1000);
  ASSERT_EQ(KSPSolve(solver, right.get(), solution.get()), 0);
  KSPConvergedReason reason;
  KSPGetConvergedReason(solver, &reason);
  EXPECT_GT(reason, 0);
}

/// Every entry must find its room: PETSc would take more, but that copies the whole matrix.
void assemble(const MatrixHandle& matrix)
{
  ASSERT_EQ(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY), 0);
  ASSERT_EQ(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY), 0);
  MatInfo info;
  MatGetInfo(matrix.get(), MAT_LOCAL, &info);
  EXPECT_EQ(info.mallocs, 0);
}

template <class DimTag>
class NodeVectorSolve : public OnActiveNodes<DimTag> {
 protected:
  static constexpr int dim = DimTag::value;
  using Active = ActiveNodes<dim>;

  static double linear(const Vec<dim>& x)
  {
    double value = 0.25;
    for (int d = 0; d < dim; ++d) value += (d == 1 ? -0.75 : 0.5 + d) * x[d];
    return value;
  }

  /// The field at every node that has a row here, also where another rank owns it; unknown c is
  /// c + 1 times the field.
  static void expect_field(const Active& active, const VectorHandle& vector, int width,
                           const Field<dim>& field)
  {
    const GridTopology<dim>& topology = active.topology();
    std::vector<double> values(std::size_t(topology.size()) * width);
    active.rows().from_vector(vector.get(), {values.data(), width, width});
    for (LocalIndex node = 0; node < topology.size(); ++node) {
      if (active.rows().of(node) < 0) continue;
      for (int c = 0; c < width; ++c)
        EXPECT_NEAR(values[std::size_t(node) * width + c], (c + 1) * field(topology.position(node)),
                    tolerance)
            << "node " << topology.index(node).transpose();
    }
  }

  /// Laplace's equation with the values of a field on the rim, by linear functions, gives it back
  /// inside as well. `on_rim`: of active nodes.
  static void expect_laplace_gives(const Active& active, const Field<dim>& field,
                                   const std::function<bool(const IndexVec<dim>&)>& on_rim)
  {
    const NodeRows<dim>& rows = active.rows();
    const MatrixHandle matrix = rows.matrix(1, 1);
    const LinearCell<dim> cell(active.geometry().spacing);
    active.for_each_cell([&](const IndexVec<dim>&, const std::vector<PetscInt>& nodes) {
      const PetscInt n = PetscInt(nodes.size());
      MatSetValues(matrix.get(), n, nodes.data(), n, nodes.data(), cell.stiffness().data(),
                   ADD_VALUES);
    });
    assemble(matrix);
    std::vector<double> values(active.topology().size(), 0.0);
    std::vector<PetscInt> fixed;
    for (const LocalIndex node : rows.owned()) {
      if (!on_rim(active.topology().index(node))) continue;
      values[node] = field(active.topology().position(node));
      fixed.push_back(PetscInt(rows.of(node)));
    }
    const VectorHandle given = rows.vector(1), right = rows.vector(1), solution = rows.vector(1);
    rows.to_vector({values.data(), 1, 1}, given.get());
    MatZeroRowsColumns(matrix.get(), PetscInt(fixed.size()), fixed.data(), 1, given.get(),
                       right.get());
    solve(matrix, right, solution);
    expect_field(active, solution, 1, field);
  }
};
TYPED_TEST_SUITE(NodeVectorSolve, Dimensions);

/// The integral over a cell of a field times the cell's function of node i: two points per axis
/// integrate products of degree two exactly.
template <int Dim>
double integral_of(const Field<Dim>& field, const Vec<Dim>& corner, const Vec<Dim>& spacing, int i)
{
  double integral = 0;
  for (int point = 0; point < 1 << Dim; ++point) {
    double weight = spacing.prod() / (1 << Dim);
    Vec<Dim> x = corner;
    for (int d = 0; d < Dim; ++d) {
      const double at = 0.5 + ((point >> d) & 1 ? 0.5 : -0.5) / std::sqrt(3.0);
      x[d] += at * spacing[d];
      weight *= (i >> d) & 1 ? at : 1 - at;
    }
    integral += weight * field(x);
  }
  return integral;
}

TYPED_TEST(NodeVectorSolve, ConsistentMassGivesTheNodeValuesOfALinearField)
{
  constexpr int dim = TestFixture::dim;
  const GridGeometry<dim> geometry = oblong_grid<dim>();
  const LinearCell<dim> cell(geometry.spacing);
  TestFixture::on_all_maps(geometry, TestFixture::ball(geometry), [&](const auto& active) {
    const NodeRows<dim>& rows = active.rows();
    const MatrixHandle matrix = rows.matrix(dim, 1);
    const VectorHandle right = rows.vector(dim), solution = rows.vector(dim);
    active.for_each_cell([&](const IndexVec<dim>& lower, const std::vector<PetscInt>& nodes) {
      const int n = int(nodes.size());
      Vec<dim> corner;
      for (int d = 0; d < dim; ++d) corner[d] = geometry.node_position(d, lower[d]);
      for (int i = 0; i < n; ++i)
        for (int c = 0; c < dim; ++c) {
          const double integral =
              integral_of<dim>(TestFixture::linear, corner, geometry.spacing, i);
          VecSetValue(right.get(), nodes[i] * dim + c, (c + 1) * integral, ADD_VALUES);
          for (int j = 0; j < n; ++j)
            MatSetValue(matrix.get(), nodes[i] * dim + c, nodes[j] * dim + c,
                        cell.mass()[i * n + j], ADD_VALUES);
        }
    });
    assemble(matrix);
    VecAssemblyBegin(right.get());
    VecAssemblyEnd(right.get());
    solve(matrix, right, solution);
    TestFixture::expect_field(active, solution, dim, TestFixture::linear);
  });
}

TYPED_TEST(NodeVectorSolve, LaplacesEquationGivesLinearFieldsOnAnyCells)
{
  constexpr int dim = TestFixture::dim;
  const GridGeometry<dim> geometry = oblong_grid<dim>();
  TestFixture::on_all_maps(geometry, TestFixture::ball(geometry), [](const auto& active) {
    TestFixture::expect_laplace_gives(active, TestFixture::linear, [&](const IndexVec<dim>& node) {
      return !active.is_inside(node);
    });
  });
}

TYPED_TEST(NodeVectorSolve, LaplacesEquationGivesAHarmonicQuadraticFieldOnSquareCells)
{
  // The operator treats the axes of a square or cube alike, so that it maps x^2 - y^2 to 0.
  constexpr int dim = TestFixture::dim;
  GridGeometry<dim> geometry = oblong_grid<dim>();
  geometry.spacing = Vec<dim>::Constant(0.125);
  const auto harmonic = [](const Vec<dim>& x) {
    return x.squaredNorm() - dim * x[dim - 1] * x[dim - 1];
  };
  // An L: the grid without the corner of upper x and y.
  const auto angle = [n = geometry.nodes](const IndexVec<dim>& cell) {
    return 2 * cell[0] < n[0] || 2 * cell[1] < n[1];
  };
  TestFixture::on_all_maps(geometry, angle, [&](const auto& active) {
    TestFixture::expect_laplace_gives(
        active, harmonic, [&](const IndexVec<dim>& node) { return !active.is_inside(node); });
  });
}

TYPED_TEST(NodeVectorSolve, LaplacesEquationOnAPeriodicAxisGivesAWaveThatFadesAcrossTheOther)
{
  // cos(a i) r^j with a = 2 pi / n solves the difference equation of the linear cells if
  // k_x m_y(s) + m_x k_y(s) = 0, s = r + 1 / r, with the symbols of an edge's matrices:
  // k = (2 - s) / h and m = h (4 + s) / 6, along x with s = 2 cos a.
  constexpr int dim = TestFixture::dim;
  GridGeometry<dim> geometry = oblong_grid<dim>();
  geometry.periodic[0] = true;
  const double hx = geometry.spacing[0], hy = geometry.spacing[1];
  const double angle = 2 * std::numbers::pi / geometry.nodes[0];
  const double kx = 2 * (1 - std::cos(angle)) / hx, mx = hx * (4 + 2 * std::cos(angle)) / 6;
  const double s = (4 * kx * hy / 6 + 2 * mx / hy) / (mx / hy - kx * hy / 6);
  const double r = s / 2 - std::sqrt(s * s / 4 - 1);
  const auto wave = [&](const Vec<dim>& x) {
    return std::cos(angle * (x[0] - geometry.origin[0]) / hx) *
           std::pow(r, (x[1] - geometry.origin[1]) / hy);
  };
  const LocalIndex top = geometry.nodes[1] - 4;  // nodes above are inactive
  TestFixture::on_all_maps(
      geometry, [&](const IndexVec<dim>& cell) { return cell[1] < top; },
      [&](const ActiveNodes<dim>& active) {
        TestFixture::expect_laplace_gives(active, wave, [&](const IndexVec<dim>& node) {
          return node[1] == 0 || node[1] == top;
        });
      });
}

}  // namespace
}  // namespace mpm
