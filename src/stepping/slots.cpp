#include <mpm/stepping/slots.hpp>

#include <algorithm>
#include <string>

namespace mpm {

template <int Dim>
bool Slots<Dim>::need_surfaces() const
{
  return std::ranges::any_of(contacts,
                             [](const auto& contact) { return contact->needs_surfaces(); });
}

template <int Dim>
void Slots<Dim>::scatter(const BodyPart<Dim>& part, const Transfer<Dim>& transfer,
                         const GridTopology<Dim>& grid, NodeFields<Dim>& fields, double time) const
{
  loads.scatter(part, transfer, grid, fields, time);
  for (const auto& condition : conditions)
    if (condition->pushes())
      transfer.outside_force(part, grid, fields.force_column(),
                             [&](LocalIndex block, Lanes(&force)[Dim]) {
                               return condition->push(part.body, block, time, force);
                             });
}

template <int Dim>
double Slots<Dim>::largest_step() const
{
  double step = loads.largest_step();
  for (const auto& contact : contacts) step = std::min(step, contact->largest_step());
  for (const auto& transport : transports) step = std::min(step, transport->largest_step());
  return step;
}

template <int Dim>
void Slots<Dim>::archive(Archive& archive)
{
  const auto all = [&](const char* kind, auto& members) {
    for (std::size_t k = 0; k < members.size(); ++k) {
      const Archive::Section section(archive, kind + std::to_string(k));
      members[k]->archive(archive);
    }
  };
  {
    const Archive::Section section(archive, "loads");
    loads.archive(archive);
  }
  all("contact", contacts);
  all("condition", conditions);
  all("transport", transports);
}

template struct Slots<2>;
template struct Slots<3>;

}  // namespace mpm
