#include <mpm/conditions/body_contact.hpp>
#include <mpm/simulation/body_contacts.hpp>
#include <mpm/simulation/method.hpp>

#include <algorithm>

namespace mpm {

std::vector<int> fields_of_bodies(const scene::Scene& scene, const std::vector<std::string>& names)
{
  const auto is_named = [&](const std::string& name) {
    return std::ranges::any_of(scene.contacts, [&](const scene::BodyContact& contact) {
      return std::ranges::find(contact.between, name) != contact.between.end();
    });
  };
  std::vector<int> fields(names.size(), 0);
  int next = std::ranges::all_of(names, is_named) ? 0 : 1;
  for (std::size_t b = 0; b < names.size(); ++b)
    if (is_named(names[b])) fields[b] = next++;
  return fields;
}

BodyPairs pairs_of_bodies(const scene::Scene& scene, const std::vector<std::string>& names)
{
  BodyPairs pairs(int(names.size()));
  for (const scene::BodyContact& contact : scene.contacts) {
    const auto first = std::ranges::find(names, contact.between[0]);
    const auto second = std::ranges::find(names, contact.between[1]);
    if (first != names.end() && second != names.end())
      pairs.add(int(first - names.begin()), int(second - names.begin()), contact.friction);
  }
  return pairs;
}

template <int Dim>
void add_contact(const scene::Scene& scene, const Layout<Dim>& layout, Model<Dim>& model)
{
  if (scene.contacts.empty() || is_total_lagrangian(scene.numerics)) return;
  std::vector<std::string> names;
  for (const Body<Dim>& body : model.bodies) names.push_back(body.name);
  const std::vector<int> fields = fields_of_bodies(scene, names);
  for (std::size_t b = 0; b < names.size(); ++b) model.bodies[b].field = fields[b];
  std::vector<typename BodyContact<Dim>::Pair> pairs;
  for (const scene::BodyContact& contact : scene.contacts) {
    const auto first = std::ranges::find(names, contact.between[0]);
    const auto second = std::ranges::find(names, contact.between[1]);
    if (first == names.end() || second == names.end()) continue;  // without particles
    pairs.push_back({fields[std::size_t(first - names.begin())],
                     fields[std::size_t(second - names.begin())], contact.friction});
  }
  const auto transfer = make_transfer<Dim>(scene.numerics, layout.per_cell);
  const double size = 1.0 / layout.per_cell;
  const auto weight = [&](double distance) { return transfer->weight_along(distance, size); };
  model.slots.contacts.push_back(std::make_unique<BodyContact<Dim>>(
      *std::ranges::max_element(fields) + 1, pairs, SurfacePlace(weight, size),
      reaction_book(scene.numerics)));
}

template void add_contact(const scene::Scene&, const Layout<2>&, Model<2>&);
template void add_contact(const scene::Scene&, const Layout<3>&, Model<3>&);

}  // namespace mpm
