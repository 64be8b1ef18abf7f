#pragma once
/// The words a scene file uses for each choice, in the order of the reference page.

#include <mpm/scene/scene.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::scene {

template <class Choice>
struct Named {
  Choice value;
  std::string_view name;
};

/// Specialised below for each choice.
template <class Choice>
inline constexpr std::array<Named<Choice>, 0> names_of{};

template <>
inline constexpr auto names_of<Side> = [] {
  std::array<Named<Side>, side_words.size()> names{};
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = {Side(k), side_words[k]};
  return names;
}();
template <>
inline constexpr auto names_of<Axis> =
    std::to_array<Named<Axis>>({{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}});
template <>
inline constexpr auto names_of<Plane> = std::to_array<Named<Plane>>({{Plane::strain, "strain"},
                                                                     {Plane::stress, "stress"}});
template <>
inline constexpr auto names_of<Wall> = std::to_array<Named<Wall>>({{Wall::bright, "bright"},
                                                                   {Wall::dark, "dark"}});
template <>
inline constexpr auto names_of<Sampling> = std::to_array<Named<Sampling>>(
    {{Sampling::match, "match"}, {Sampling::threshold, "threshold"}});
template <>
inline constexpr auto names_of<DecompositionKind> =
    std::to_array<Named<DecompositionKind>>({{DecompositionKind::automatic, "auto"},
                                             {DecompositionKind::cuts, "cuts"},
                                             {DecompositionKind::metis, "metis"}});
template <>
inline constexpr auto names_of<FormulationKind> = std::to_array<Named<FormulationKind>>(
    {{FormulationKind::updated_lagrangian, "updated_lagrangian"},
     {FormulationKind::total_lagrangian, "total_lagrangian"}});
template <>
inline constexpr auto names_of<Surface> =
    std::to_array<Named<Surface>>({{Surface::stairs, "stairs"}, {Surface::fitted, "fitted"}});
template <>
inline constexpr auto names_of<Recovery> =
    std::to_array<Named<Recovery>>({{Recovery::stop, "stop"}, {Recovery::retry, "retry"}});
template <>
inline constexpr auto names_of<Grip> = std::to_array<Named<Grip>>({{Grip::stick, "stick"},
                                                                   {Grip::slip, "slip"},
                                                                   {Grip::contact, "contact"}});
template <>
inline constexpr auto names_of<Field> =
    std::to_array<Named<Field>>({{Field::velocity, "velocity"},
                                 {Field::stress, "stress"},
                                 {Field::von_mises, "von_mises"},
                                 {Field::pressure, "pressure"},
                                 {Field::volume_ratio, "volume_ratio"},
                                 {Field::plastic_strain, "plastic_strain"},
                                 {Field::plastic_work, "plastic_work"},
                                 {Field::material, "material"},
                                 {Field::id, "id"},
                                 {Field::rank, "rank"}});

template <class Choice>
std::string_view name_of(Choice choice)
{
  for (const auto& named : names_of<Choice>)
    if (named.value == choice) return named.name;
  return {};
}

template <class Choice>
std::vector<std::string> all_names()
{
  std::vector<std::string> names;
  for (const auto& named : names_of<Choice>) names.emplace_back(named.name);
  return names;
}

}  // namespace mpm::scene
