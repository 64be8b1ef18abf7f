#pragma once
/// The transfer formulae written out plainly: one particle, one node, one axis at a time, every
/// particle with every node. Weights from their published piecewise definitions.

#include <mpm/shape/carries_domain.hpp>
#include <mpm/shape/shape_types.hpp>
#include <mpm/transfer/scheme_types.hpp>
#include <mpm/transfer/transfer.hpp>

#include <Eigen/LU>
#include <cmath>

#include "recording_law.hpp"

namespace mpm {

struct NaiveShape {
  OneOf<ShapeRow> kind;
  double l;  ///< half size of a particle domain in cells

  /// r = (x_p - x_i) / h
  double weight(double r) const
  {
    const double a = std::abs(r);
    if (kind == "linear") return a < 1 ? 1 - a : 0;
    if (kind == "quadratic")
      return a < 0.5 ? 0.75 - r * r : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0;
    if (kind != "gimp") return sampled(r).first;
    if (a < l) return 1 - (r * r + l * l) / (2 * l);
    if (a <= 1 - l) return 1 - a;
    return a < 1 + l ? (1 + l - a) * (1 + l - a) / (4 * l) : 0;
  }
  double slope(double r) const
  {
    const double a = std::abs(r), s = r < 0 ? -1 : 1;
    if (kind == "linear") return r >= -1 && r < 1 ? -s : 0;
    if (kind == "quadratic") return a < 0.5 ? -2 * r : a < 1.5 ? -s * (1.5 - a) : 0;
    if (kind != "gimp") return sampled(r).second;
    if (a < l) return -r / l;
    if (a <= 1 - l) return -s;
    return a < 1 + l ? -s * (1 + l - a) / (2 * l) : 0;
  }

 private:
  /// Weight and slope of a shape function that is not written out here, from its own code: that one
  /// is tested by itself (tests/unit/shape).
  std::pair<double, double> sampled(double r) const
  {
    std::pair<double, double> result{0, 0};
    for_each_type(ShapeTypes{}, [&]<class Shape>() {
      if constexpr (!CarriesDomain<Shape>) {
        if (kind != Shape::row.keyword) return;
        const Shape shape = Shape::make(2 * l);
        const double base = std::floor(r - shape.base_shift());
        Lanes w[Shape::support], g[Shape::support];
        shape.weights(Lanes(r - base), 1, w, g);
        if (base <= 0 && -base < Shape::support) result = {w[int(-base)][0], g[int(-base)][0]};
      }
    });
    return result;
  }
};

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
struct NaiveParticle {
  Vec<Dim> x, v, u = Vec<Dim>::Zero();
  double mass, volume;
  Matrix<Dim> affine = Matrix<Dim>::Zero(), stress, gradient = Matrix<Dim>::Zero();
  Matrix<Dim> domain = Matrix<Dim>::Zero();  ///< half axes as columns, m
};

template <int Dim>
struct NaiveNode {
  Vec<Dim> x;
  double mass = 0;
  Vec<Dim> momentum = Vec<Dim>::Zero(), force = Vec<Dim>::Zero();
  Vec<Dim> velocity = Vec<Dim>::Zero(), increment = Vec<Dim>::Zero();
  Vec<Dim> gradient_velocity = Vec<Dim>::Zero();
};

template <int Dim>
struct NaiveTransfer {
  using Particles = std::vector<NaiveParticle<Dim>>;
  using Nodes = std::vector<NaiveNode<Dim>>;

  NaiveShape shape;
  OneOf<SchemeRow> scheme;
  Vec<Dim> h;

  bool affine() const { return scheme->affine; }

  bool has_domain() const { return shape.kind == "cpdi"; }

  double weight(const NaiveParticle<Dim>& p, const NaiveNode<Dim>& node) const
  {
    if (has_domain()) return of_corners(p, node).first;
    double w = 1;
    for (int d = 0; d < Dim; ++d) w *= shape.weight((p.x[d] - node.x[d]) / h[d]);
    return w;
  }
  Vec<Dim> gradient(const NaiveParticle<Dim>& p, const NaiveNode<Dim>& node) const
  {
    if (has_domain()) return of_corners(p, node).second;
    Vec<Dim> g = Vec<Dim>::Ones();
    for (int d = 0; d < Dim; ++d)
      for (int k = 0; k < Dim; ++k) {
        const double r = (p.x[k] - node.x[k]) / h[k];
        g[d] *= k == d ? shape.slope(r) / h[k] : shape.weight(r);
      }
    return g;
  }

  /// CPDI: what the weights see of a domain. Along no axis it reaches farther than a cell, or less
  /// than half of what it does at rest; a domain without volume is that of a particle at rest.
  Matrix<Dim> seen_domain(const NaiveParticle<Dim>& p) const
  {
    Matrix<Dim> seen = p.domain;
    for (int d = 0; d < Dim; ++d) {
      const double reach = p.domain.row(d).cwiseAbs().sum();
      if (reach > h[d]) seen.row(d) *= h[d] / reach;
      const double least = 0.5 * shape.l * h[d];
      if (reach > 0 && reach < least) seen.row(d) *= least / reach;
    }
    if (seen.determinant() > 1e-9 * h.prod()) return seen;
    return shape.l * Matrix<Dim>(h.asDiagonal());
  }
  /// CPDI: weight and gradient from the hats at the corners.
  std::pair<double, Vec<Dim>> of_corners(const NaiveParticle<Dim>& p,
                                         const NaiveNode<Dim>& node) const
  {
    const Matrix<Dim> domain = seen_domain(p), to_gradient = domain.inverse().transpose();
    double w = 0;
    Vec<Dim> g = Vec<Dim>::Zero();
    constexpr int corners = 1 << Dim;
    for (int c = 0; c < corners; ++c) {
      Vec<Dim> sign;
      for (int d = 0; d < Dim; ++d) sign[d] = (c >> d) % 2 == 1 ? 1 : -1;
      const Vec<Dim> corner = p.x + domain * sign;
      double hat = 1.0 / corners;
      for (int d = 0; d < Dim; ++d)
        hat *= std::max(0.0, 1 - std::abs(corner[d] - node.x[d]) / h[d]);
      w += hat;
      g += hat * to_gradient * sign;
    }
    return {w, g};
  }

  /// Adds mass, momentum (with the affine part) and internal force.
  void to_grid(const Particles& particles, Nodes& nodes) const
  {
    for (const auto& p : particles)
      for (auto& node : nodes) {
        const double w = weight(p, node);
        node.mass += w * p.mass;
        node.momentum += w * p.mass * (p.v + p.affine * (node.x - p.x));
        node.force -= p.volume * p.stress * gradient(p, node);
      }
  }

  /// Velocity, affine field and the velocity to move with.
  void velocity_to_particles(const Nodes& nodes, Particles& particles) const
  {
    bool gradients = false;  // the affine field comes from gradients of the shape function
    for_each_type(SchemeTypes{}, [&]<class Scheme>() {
      if (scheme == Scheme::row.keyword) gradients = Scheme::shape_gradient;
    });
    for (auto& p : particles) {
      Vec<Dim> increment = Vec<Dim>::Zero();
      Matrix<Dim> moment = Matrix<Dim>::Zero(), b = Matrix<Dim>::Zero();
      p.u.setZero();
      for (const auto& node : nodes) {
        const double w = weight(p, node);
        const Vec<Dim> offset = node.x - p.x;
        p.u += w * node.velocity;
        increment += w * node.increment;
        moment += w * offset * offset.transpose();
        b += gradients ? Matrix<Dim>(node.velocity * gradient(p, node).transpose())
                       : Matrix<Dim>(w * node.velocity * offset.transpose());
      }
      p.v = scheme->book == ReactionBook::increments ? Vec<Dim>(p.v + increment) : p.u;
      if (affine()) p.affine = gradients ? b : Matrix<Dim>(b * moment.inverse());
    }
  }

  void stress_update(const Nodes& nodes, Particles& particles, double dt) const
  {
    using Constants = RecordingLaw<Dim>;
    for (auto& p : particles) {
      p.gradient.setZero();
      for (const auto& node : nodes)
        p.gradient += node.gradient_velocity * gradient(p, node).transpose();
      p.stress += dt * (Constants::mu * (p.gradient + p.gradient.transpose()) +
                        Constants::lambda * p.gradient.trace() * Matrix<Dim>::Identity());
    }
  }

  void gradient_velocity_to_moves(const Nodes& nodes, Particles& particles) const
  {
    for (auto& p : particles) {
      p.u.setZero();
      for (const auto& node : nodes) p.u += weight(p, node) * node.gradient_velocity;
    }
  }

  /// With the gradient that the stress has seen.
  static void move(Particles& particles, double dt)
  {
    for (auto& p : particles) {
      p.x += dt * p.u;
      p.domain += dt * p.gradient * p.domain;
    }
  }
  /// With that of the velocity that moves the particle.
  void move_with_updated_velocity(const Nodes& nodes, Particles& particles, double dt) const
  {
    for (auto& p : particles) {
      Matrix<Dim> carrier = Matrix<Dim>::Zero();
      for (const auto& node : nodes) carrier += node.velocity * gradient(p, node).transpose();
      p.x += dt * p.u;
      p.domain += dt * carrier * p.domain;
    }
  }
};

}  // namespace mpm
