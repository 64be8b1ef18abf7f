#pragma once
/// What the passes are made of: over blocks of particles, compiled per dimension, shape function,
/// scheme and content.

#include <mpm/transfer/block_columns.hpp>
#include <mpm/transfer/domain_gather.hpp>
#include <mpm/transfer/gather.hpp>
#include <mpm/transfer/particle_faults.hpp>
#include <mpm/transfer/scatter.hpp>
#include <mpm/transfer/scheme.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mpm {

template <int Dim, class Shape, class Scheme>
class KernelPass {
  static constexpr bool has_domain = CarriesDomain<Shape>;

 public:
  using Columns = MotionColumns<Dim, Scheme, has_domain>;

  KernelPass(const TransferOptions& options)
      : shape_(Shape::make(options.domain)), pic_share_(options.pic_share), f_bar_(options.f_bar)
  {
  }

  /// At the particles' place.
  [[gnu::always_inline]] Stencil<Dim, Shape> stencil_of(const double* motion,
                                                        const GridFrame<Dim>& frame) const
  {
    Lanes x[Dim];
    load_all(motion, Columns::position, x);
    return stencil_at(x, motion, frame);
  }
  /// At a place that may not be in the columns yet.
  template <bool WithGradient = true>
  [[gnu::always_inline]] Stencil<Dim, Shape> stencil_at(const Lanes (&x)[Dim], const double* motion,
                                                        const GridFrame<Dim>& frame) const
  {
    if constexpr (has_domain) {
      Lanes domain[Dim * Dim];
      load_all(motion, Columns::domain, domain);
      return Stencil<Dim, Shape>(x, domain, frame, shape_);
    } else {
      return Stencil<Dim, Shape>(x, frame, shape_, std::bool_constant<WithGradient>());
    }
  }

  /// Along one axis, of a node at this distance from a particle at rest; lengths in cells.
  double weight_along(double distance, double size) const
  {
    if constexpr (has_domain) {
      const auto hat = [](double x) { return std::max(0.0, 1.0 - std::abs(x)); };
      return 0.5 * (hat(distance - 0.5 * size) + hat(distance + 0.5 * size));
    } else {
      constexpr int n = Shape::support;
      Lanes w[n], g[n];
      // The particle stands behind node 0 of its stencil, and the node is number `node` of it.
      const double first = std::floor(distance - shape_.base_shift());
      const int node = -int(first);
      if (node < 0 || node >= n) return 0;
      shape_.weights(Lanes(distance - first), 1, w, g);
      return w[node][0];
    }
  }

  /// Over the blocks of a part. `bounds` only for passes that move.
  template <PassContent Content>
  PassOutcome<Dim> run(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                       NodeFields<Dim>& fields, double dt, const MoveBounds<Dim>* bounds) const
  {
    constexpr int stress_width = symmetric_components<Dim> * lane_count;
    constexpr int gradient_width = Dim * Dim * lane_count;
    alignas(lane_alignment) double gradient[chunk * gradient_width];
    alignas(lane_alignment) double force_stress[chunk * stress_width];
    // As gathered, without means over nodes: what the chunk's domains move with.
    constexpr int kept = !has_domain || !Content.move ? 0 : Content.gradient ? chunk : 1;
    [[maybe_unused]] alignas(lane_alignment) double carrier[std::max(1, kept * gradient_width)];

    const GridFrame<Dim> frame(grid, !part.interior), force_frame = frame.with_negative_gradients();
    [[maybe_unused]] const double stress_dt = Content.half_stress ? 0.5 * dt : dt;
    [[maybe_unused]] const double rate = 1 / stress_dt;
    PassOutcome<Dim> outcome;
    Lanes largest_speed = 0.0;
    Scatter<Dim, Shape, Content.scatter> scatter(grid, fields);
    ParticleStore& particles = part.body.particles;
    if constexpr (Content.gradient)
      gather_gradients<Content>(particles, part.first, part.end, frame, grid, fields, gradient);
    for (LocalIndex first = part.first; first < part.end; first += chunk) {
      const int blocks = std::min(chunk, int(part.end - first));
      double* state = particles.state().block(first);
      fetch_ahead<Content>(particles, std::min(first + blocks_ahead, part.end - 1));
      if constexpr (Content.gradient) {
        if constexpr (has_domain && Content.move)
          std::copy_n(gradient, blocks * gradient_width, carrier);
        if (f_bar_) [[unlikely]]
          take_divergences(particles, first, blocks, frame, grid, fields, gradient);
        for (int k = 0; k < blocks; ++k) {
          const Lanes f = step_determinant<Dim>(gradient + k * gradient_width, rate);
          if (!stdx::all_of(f > 0.0)) [[unlikely]]
            report_inverted(particles, first + k, f, stress_dt, outcome);
        }
        part.body.law->update(state, blocks, gradient, stress_dt, force_stress);
        // The law's arithmetic is one long chain; what the next blocks gather fills its gaps.
        gather_gradients<Content>(particles, first + chunk, part.end, frame, grid, fields,
                                  gradient);
      } else if constexpr (Content.scatter.force) {
        part.body.law->force_stress(state, blocks, force_stress);
      }
      for (int k = 0; k < blocks; ++k)
        move_and_scatter<Content>(particles, first + k, frame, force_frame, grid, fields, dt,
                                  bounds, force_stress + k * stress_width,
                                  carrier + (kept > 1 ? k * gradient_width : 0), scatter,
                                  largest_speed, outcome);
    }
    outcome.largest_speed = stdx::hmax(largest_speed);
    return outcome;
  }

 private:
  /// Blocks per call of the law. Few: the law's arithmetic then runs beside the memory traffic of
  /// the transfer (with 16 particles instead of 8 a step took a seventh longer).
  static constexpr int chunk = std::max(1, 8 / lane_count);
  /// From asking for a block to working on it.
  static constexpr int blocks_ahead = 4 * chunk;

  template <PassContent Content>
  [[gnu::always_inline]] static void fetch_ahead(ParticleStore& particles, LocalIndex block)
  {
    fetch(particles.motion(), block);
    if constexpr (Content.gradient || Content.scatter.force) fetch(particles.state(), block);
  }

  /// Of the chunk from `first` on, as far as there are blocks before `end`. A move by the same
  /// velocity takes the place of the one by the updated velocity.
  template <PassContent Content>
  [[gnu::always_inline]] void gather_gradients(ParticleStore& particles, LocalIndex first,
                                               LocalIndex end, const GridFrame<Dim>& frame,
                                               const GridTopology<Dim>& grid,
                                               const NodeFields<Dim>& fields,
                                               double* gradient) const
  {
    for (LocalIndex b = first; b < std::min(first + chunk, end); ++b) {
      double* motion = particles.motion().block(b);
      const Stencil<Dim, Shape> stencil = stencil_of(motion, frame);
      gather_gradient(stencil, grid, fields, gradient);
      if constexpr (Content.one_displacement) {
        Lanes u[Dim];
        gather_gradient_velocity(stencil, grid, fields, u);
        store_all(u, motion, Columns::grid_velocity);
      }
      gradient += Dim * Dim * lane_count;
    }
  }

  /// F-bar, of the chunk that has just been gathered. Apart: nothing of it is kept at hand before.
  [[gnu::noinline]] void take_divergences(const ParticleStore& particles, LocalIndex first,
                                          int blocks, const GridFrame<Dim>& frame,
                                          const GridTopology<Dim>& grid,
                                          const NodeFields<Dim>& fields, double* gradient) const
  {
    for (LocalIndex b = first; b < first + blocks; ++b) {
      take_divergence(stencil_of(particles.motion().block(b), frame), grid, fields, gradient);
      gradient += Dim * Dim * lane_count;
    }
  }

  template <PassContent Content>
  [[gnu::always_inline]] void move_and_scatter(
      ParticleStore& particles, LocalIndex block, const GridFrame<Dim>& frame,
      const GridFrame<Dim>& force_frame, const GridTopology<Dim>& grid,
      const NodeFields<Dim>& fields, double dt, const MoveBounds<Dim>* bounds,
      const double* force_stress, [[maybe_unused]] double* carrier,
      Scatter<Dim, Shape, Content.scatter>& scatter, Lanes& largest_speed,
      PassOutcome<Dim>& outcome) const
  {
    constexpr bool needs_affine =
        Scheme::affine && (Content.scatter.momentum || Content.scatter.remap);
    double* motion = particles.motion().block(block);
    Lanes x[Dim], v[Dim], u[Dim], affine[Dim * Dim];
    load_all(motion, Columns::position, x);
    const Lanes mass = load(motion + Columns::mass * lane_count);

    if constexpr (Content.refine) {
      const Stencil<Dim, Shape> stencil = stencil_at<false>(x, motion, frame);
      Lanes gathered[2 * Dim], momentum[Dim];
      gather_velocity<false>(stencil, grid, fields, stencil.gradient, gathered, affine);
      for (int d = 0; d < Dim; ++d) momentum[d] = mass * gathered[Dim + d];
      scatter.template add<false>(stencil, mass, momentum, force_stress, affine);
      return;
    }
    if constexpr (Content.velocity) {
      Stencil<Dim, Shape> stencil = stencil_at<Scheme::affine>(x, motion, frame);
      alignas(lane_alignment) typename Stencil<Dim, Shape>::Columns affine_weight;
      if constexpr (Scheme::affine) {
        stencil.measure_offsets(frame);
        if constexpr (Scheme::shape_gradient)
          std::memcpy(affine_weight, stencil.gradient, sizeof affine_weight);
        else
          stencil.affine_weights(affine_weight);
      }
      Lanes gathered[2 * Dim];
      gather_velocity<Scheme::affine>(stencil, grid, fields, affine_weight, gathered, affine);
      if constexpr (Scheme::increments) load_all(motion, Columns::velocity, v);
      for (int d = 0; d < Dim; ++d) {
        u[d] = gathered[d];
        v[d] = Scheme::increments ? v[d] + gathered[Dim + d] : gathered[d];
      }
      if constexpr (Scheme::blends)
        for (int d = 0; d < Dim; ++d) v[d] += pic_share_ * (u[d] - v[d]);
      store_all(v, motion, Columns::velocity);
      if constexpr (Scheme::affine) store_all(affine, motion, Columns::affine);
      if constexpr (!Content.move) {
        store_all(u, motion, Columns::grid_velocity);
        Lanes momentum[Dim];
        for (int d = 0; d < Dim; ++d) momentum[d] = mass * v[d];
        if constexpr (needs_affine)
          for (Lanes& a : affine) a *= mass;
        scatter.template add<needs_affine>(stencil, mass, momentum, force_stress, affine);
        return;
      }
    } else if constexpr (Content.scatter.momentum) {
      load_all(motion, Columns::velocity, v);
    } else {
      for (Lanes& component : v) component = 0.0;
    }

    if constexpr (Content.move) {
      if constexpr (has_domain) {
        if constexpr (!Content.gradient)
          gather_gradient_of(fields.updated, NodeFields<Dim>::record_width,
                             stencil_at(x, motion, frame), grid, carrier);
        carry_domain<Dim>(carrier, dt, motion + Columns::domain * lane_count);
      }
      if constexpr (!Content.velocity) load_all(motion, Columns::grid_velocity, u);
      LaneMask reach(true);
      for (int d = 0; d < Dim; ++d) {
        largest_speed = stdx::max(largest_speed, stdx::abs(u[d]));
        x[d] += dt * u[d];
        reach = reach && x[d] >= bounds->reach_lower[d] && x[d] < bounds->reach_upper[d];
      }
      if (!stdx::all_of(reach)) [[unlikely]]
        report_lost(particles, block, reach, v, *bounds, x, outcome);
      store_all(x, motion, Columns::position);
    }

    Stencil<Dim, Shape> stencil = stencil_at<Content.scatter.force>(x, motion, force_frame);
    Lanes momentum[Dim];
    for (int d = 0; d < Dim; ++d) momentum[d] = mass * v[d];
    if constexpr (needs_affine) {
      stencil.measure_offsets(frame);
      if constexpr (!Content.velocity) load_all(motion, Columns::affine, affine);
      for (Lanes& a : affine) a *= mass;
    }
    scatter.template add<needs_affine>(stencil, mass, momentum, force_stress, affine);
  }

  Shape shape_;
  double pic_share_;
  bool f_bar_;
};

}  // namespace mpm
