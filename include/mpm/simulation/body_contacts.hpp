#pragma once
/// Velocity fields or meshes of bodies, and the contact between them.

#include <mpm/lagrangian/body_pairs.hpp>
#include <mpm/simulation/model.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Velocity field of each of these bodies: its own for one that contact names, one for all others.
std::vector<int> fields_of_bodies(const scene::Scene& scene, const std::vector<std::string>& names);

/// What these bodies do in a total Lagrangian step where they meet.
BodyPairs pairs_of_bodies(const scene::Scene& scene, const std::vector<std::string>& names);

/// In the updated Lagrangian step: gives bodies their fields, and the model the contact between
/// them; nothing without any.
template <int Dim>
void add_contact(const scene::Scene& scene, const Layout<Dim>& layout, Model<Dim>& model);

}  // namespace mpm
