#pragma once
/// The passes of the update orders.

#include <mpm/transfer/kernel_pass.hpp>
#include <mpm/transfer/transfer.hpp>

#include <stdexcept>

namespace mpm {

template <int Dim, class Shape, class Scheme>
class KernelTransfer final : public Transfer<Dim> {
  using Columns = typename KernelPass<Dim, Shape, Scheme>::Columns;

 public:
  KernelTransfer(const TransferOptions& options) : kernel_(options) {}

  std::vector<Column> motion_columns(bool musl) const override { return Columns::columns(musl); }
  int support() const override { return Shape::support; }
  bool ends_at_walls() const override { return Shape::ends_at_walls; }

  void first_nodes(const ParticleStore& particles, const GridTopology<Dim>& grid,
                   std::vector<LocalIndex>& nodes) const override
  {
    const GridFrame<Dim> frame(grid);
    nodes.resize(std::size_t(particles.blocks()) * lane_count);
    for (LocalIndex b = 0; b < particles.blocks(); ++b) {
      const Stencil<Dim, Shape> stencil = kernel_.stencil_of(particles.motion().block(b), frame);
      for (int lane = 0; lane < lane_count; ++lane)
        nodes[std::size_t(b) * lane_count + lane] = LocalIndex(stencil.base[lane]);
    }
    nodes.resize(particles.size());
  }

  void prime(const BodyPart<Dim>& part, const GridTopology<Dim>& grid, NodeFields<Dim>& fields,
             bool with_force) const override
  {
    if (with_force)
      kernel_.template run<PassContent{.scatter = {.mass = true, .momentum = true, .force = true}}>(
          part, grid, fields, 0, nullptr);
    else
      kernel_.template run<PassContent{.scatter = {.mass = true, .momentum = true}}>(
          part, grid, fields, 0, nullptr);
  }

  void outside_force(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                     const NodeColumn& column,
                     const typename Transfer<Dim>::BlockForce& force) const override
  {
    const GridFrame<Dim> frame(grid, !part.interior);
    for (LocalIndex b = part.first; b < part.end; ++b) {
      Lanes f[Dim];
      for (Lanes& component : f) component = 0.0;
      if (force(b, f))
        scatter_force(kernel_.stencil_of(part.body.particles.motion().block(b), frame), grid, f,
                      column);
    }
  }

  PassOutcome<Dim> surface(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                           NodeFields<Dim>& fields, std::span<const char> asked) const override
  {
    const GridFrame<Dim> frame(grid, !part.interior);
    for (LocalIndex b = part.first; b < part.end; ++b) {
      const double* motion = part.body.particles.motion().block(b);
      Stencil<Dim, Shape> stencil = kernel_.stencil_of(motion, frame);
      bool is_asked = false;
      for (int lane = 0; lane < lane_count; ++lane)
        is_asked = is_asked || asked[std::size_t(stencil.base[lane])];
      if (!is_asked) continue;
      stencil.measure_offsets(frame);
      scatter_surface(stencil, grid, load(motion + Columns::mass * lane_count), fields);
    }
    return {};
  }

  double weight_along(double distance, double size) const override
  {
    return kernel_.weight_along(distance, size);
  }

  PassOutcome<Dim> refine_velocity(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                   NodeFields<Dim>& fields) const override
  {
    if constexpr (!Scheme::increments && !Scheme::affine)
      return kernel_.template run<PassContent{.refine = true, .scatter = {.remap = true}}>(
          part, grid, fields, 0, nullptr);
    else
      throw std::logic_error("this scheme refines no velocity");
  }

  PassOutcome<Dim> divergence(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                              NodeFields<Dim>& fields) const override
  {
    const GridFrame<Dim> frame(grid, !part.interior);
    Scatter<Dim, Shape, ScatterContent{.remap = true}> scatter(grid, fields);
    alignas(lane_alignment) double gradient[Dim * Dim * lane_count];
    for (LocalIndex b = part.first; b < part.end; ++b) {
      const double* motion = part.body.particles.motion().block(b);
      Lanes weighted[Dim], no_affine[Dim * Dim];
      const Stencil<Dim, Shape> stencil = kernel_.stencil_of(motion, frame);
      gather_gradient(stencil, grid, fields, gradient);
      const Lanes mass = load(motion + Columns::mass * lane_count);
      for (Lanes& component : weighted) component = 0.0;
      weighted[0] = mass * trace_of<Dim>(gradient);
      scatter.template add<false>(stencil, mass, weighted, nullptr, no_affine);
    }
    return {};
  }

  PassOutcome<Dim> musl_velocity(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                 NodeFields<Dim>& fields) const override
  {
    return kernel_.template run<PassContent{.velocity = true, .scatter = {.remap = true}}>(
        part, grid, fields, 0, nullptr);
  }

  PassOutcome<Dim> musl_stress(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                               NodeFields<Dim>& fields, double dt,
                               const MoveBounds<Dim>& bounds) const override
  {
    return kernel_
        .template run<PassContent{.gradient = true,
                                  .move = true,
                                  .scatter = {.mass = true, .momentum = true, .force = true}}>(
            part, grid, fields, dt, &bounds);
  }

  PassOutcome<Dim> musl_displacement(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                     NodeFields<Dim>& fields, double dt,
                                     const MoveBounds<Dim>& bounds) const override
  {
    return kernel_
        .template run<PassContent{.gradient = true,
                                  .move = true,
                                  .one_displacement = true,
                                  .scatter = {.mass = true, .momentum = true, .force = true}}>(
            part, grid, fields, dt, &bounds);
  }

  PassOutcome<Dim> usf_stress(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                              NodeFields<Dim>& fields, double dt) const override
  {
    return kernel_.template run<PassContent{.gradient = true, .scatter = {.force = true}}>(
        part, grid, fields, dt, nullptr);
  }

  PassOutcome<Dim> usf_velocity(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                NodeFields<Dim>& fields, double dt,
                                const MoveBounds<Dim>& bounds) const override
  {
    return kernel_.template run<PassContent{
        .velocity = true, .move = true, .scatter = {.mass = true, .momentum = true}}>(
        part, grid, fields, dt, &bounds);
  }

  PassOutcome<Dim> usavg_stress(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                NodeFields<Dim>& fields, double dt,
                                const MoveBounds<Dim>& bounds) const override
  {
    return kernel_.template run<PassContent{.gradient = true,
                                            .half_stress = true,
                                            .move = true,
                                            .scatter = {.mass = true, .momentum = true}}>(
        part, grid, fields, dt, &bounds);
  }

  PassOutcome<Dim> usl(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                       NodeFields<Dim>& fields, double dt,
                       const MoveBounds<Dim>& bounds) const override
  {
    return kernel_
        .template run<PassContent{.gradient = true,
                                  .velocity = true,
                                  .move = true,
                                  .scatter = {.mass = true, .momentum = true, .force = true}}>(
            part, grid, fields, dt, &bounds);
  }

 private:
  KernelPass<Dim, Shape, Scheme> kernel_;
};

}  // namespace mpm
