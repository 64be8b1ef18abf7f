#pragma once
/// The transfer formulae written out plainly: one particle, one node, one axis at a time, every
/// particle with every node. Weights from their published piecewise definitions.

#include <mpm/transfer/transfer.hpp>

#include <Eigen/LU>
#include <cmath>

#include "recording_law.hpp"

namespace mpm {

struct NaiveShape {
  ShapeKind kind;
  double l;  ///< half size of a particle domain in cells

  /// r = (x_p - x_i) / h
  double weight(double r) const
  {
    const double a = std::abs(r);
    if (kind == ShapeKind::linear) return a < 1 ? 1 - a : 0;
    if (kind == ShapeKind::quadratic)
      return a < 0.5 ? 0.75 - r * r : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0;
    if (a < l) return 1 - (r * r + l * l) / (2 * l);
    if (a <= 1 - l) return 1 - a;
    return a < 1 + l ? (1 + l - a) * (1 + l - a) / (4 * l) : 0;
  }
  double slope(double r) const
  {
    const double a = std::abs(r), s = r < 0 ? -1 : 1;
    if (kind == ShapeKind::linear) return r >= -1 && r < 1 ? -s : 0;
    if (kind == ShapeKind::quadratic) return a < 0.5 ? -2 * r : a < 1.5 ? -s * (1.5 - a) : 0;
    if (a < l) return -r / l;
    if (a <= 1 - l) return -s;
    return a < 1 + l ? -s * (1 + l - a) / (2 * l) : 0;
  }
};

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
struct NaiveParticle {
  Vec<Dim> x, v, u = Vec<Dim>::Zero();
  double mass, volume;
  Matrix<Dim> affine = Matrix<Dim>::Zero(), stress, gradient = Matrix<Dim>::Zero();
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
  SchemeKind scheme;
  Vec<Dim> h;

  bool affine() const { return scheme == SchemeKind::apic || scheme == SchemeKind::tpic; }

  double weight(const Vec<Dim>& x, const NaiveNode<Dim>& node) const
  {
    double w = 1;
    for (int d = 0; d < Dim; ++d) w *= shape.weight((x[d] - node.x[d]) / h[d]);
    return w;
  }
  Vec<Dim> gradient(const Vec<Dim>& x, const NaiveNode<Dim>& node) const
  {
    Vec<Dim> g = Vec<Dim>::Ones();
    for (int d = 0; d < Dim; ++d)
      for (int k = 0; k < Dim; ++k) {
        const double r = (x[k] - node.x[k]) / h[k];
        g[d] *= k == d ? shape.slope(r) / h[k] : shape.weight(r);
      }
    return g;
  }

  /// Adds mass, momentum (with the affine part) and internal force.
  void to_grid(const Particles& particles, Nodes& nodes) const
  {
    for (const auto& p : particles)
      for (auto& node : nodes) {
        const double w = weight(p.x, node);
        node.mass += w * p.mass;
        node.momentum += w * p.mass * (p.v + p.affine * (node.x - p.x));
        node.force -= p.volume * p.stress * gradient(p.x, node);
      }
  }

  /// Velocity, affine field and the velocity to move with.
  void velocity_to_particles(const Nodes& nodes, Particles& particles) const
  {
    for (auto& p : particles) {
      Vec<Dim> increment = Vec<Dim>::Zero();
      Matrix<Dim> moment = Matrix<Dim>::Zero(), b = Matrix<Dim>::Zero();
      p.u.setZero();
      for (const auto& node : nodes) {
        const double w = weight(p.x, node);
        const Vec<Dim> offset = node.x - p.x;
        p.u += w * node.velocity;
        increment += w * node.increment;
        moment += w * offset * offset.transpose();
        b += scheme == SchemeKind::apic
                 ? Matrix<Dim>(w * node.velocity * offset.transpose())
                 : Matrix<Dim>(node.velocity * gradient(p.x, node).transpose());
      }
      p.v = scheme == SchemeKind::flip ? Vec<Dim>(p.v + increment) : p.u;
      if (scheme == SchemeKind::apic) p.affine = b * moment.inverse();
      if (scheme == SchemeKind::tpic) p.affine = b;
    }
  }

  void stress_update(const Nodes& nodes, Particles& particles, double dt) const
  {
    using Constants = RecordingLaw<Dim>;
    for (auto& p : particles) {
      p.gradient.setZero();
      for (const auto& node : nodes)
        p.gradient += node.gradient_velocity * gradient(p.x, node).transpose();
      p.stress += dt * (Constants::mu * (p.gradient + p.gradient.transpose()) +
                        Constants::lambda * p.gradient.trace() * Matrix<Dim>::Identity());
    }
  }

  static void move(Particles& particles, double dt)
  {
    for (auto& p : particles) p.x += dt * p.u;
  }
};

}  // namespace mpm
