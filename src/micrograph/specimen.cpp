#include <mpm/core/error.hpp>
#include <mpm/micrograph/specimen.hpp>
#include <mpm/micrograph/totals.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

/// The whole specimen, then the windows of the scene.
std::vector<scene::Window> windows_of(const scene::Scene& scene)
{
  std::vector<scene::Window> windows{scene::Window{}};
  windows.insert(windows.end(), scene.specimen.windows.begin(), scene.specimen.windows.end());
  return windows;
}

std::string text_of(const scene::Window& window, int dimensions)
{
  std::string text =
      fmt::format("x [{}, {}], y [{}, {}]", window.x[0], window.x[1], window.y[0], window.y[1]);
  if (dimensions == 3) text += fmt::format(", z [{}, {}]", window.z[0], window.z[1]);
  return text;
}

/// `material_of_label`: index into scene.materials.
std::vector<RelativeDensity> densities_of(const scene::Scene& scene,
                                          const std::vector<WindowCount>& counts,
                                          const std::vector<std::int8_t>& material_of_label)
{
  const std::vector<scene::Window> windows = windows_of(scene);
  std::vector<RelativeDensity> densities;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const WindowCount& count = counts[w];
    if (count.locations == 0)
      throw InputError(
          fmt::format("specimen.windows[{}] '{}' is {} and contains no location. Give growing "
                      "fractions between 0 and 1.",
                      w - 1, windows[w].name, text_of(windows[w], scene.dimensions)));
    double mass = 0;
    for (std::size_t label = 0; label < count.filled.size(); ++label)
      if (count.filled[label] > 0)
        mass +=
            count.filled[label] * scene.materials[std::size_t(material_of_label[label])].density();
    const double filled = std::accumulate(count.filled.begin(), count.filled.end(), 0.0);
    densities.push_back({windows[w].name, filled / count.locations, mass / count.locations});
  }
  return densities;
}

}  // namespace

template <int Dim>
Specimen<Dim>::Specimen(const scene::Scene& scene, std::optional<Picture> picture,
                        const Share& share)
    : particles_per_cell_(scene.grid.particles_per_cell)
{
  const scene::Specimen& specimen = scene.specimen;
  try {
    if (specimen.micrograph && !specimen.shapes.empty())
      throw InputError("specimen.micrograph and specimen.shapes are both given. Give one of them.");
    if (picture)
      settle_picture(scene, *std::move(picture), share);
    else
      settle_shapes(scene, share);
    if (specimen.initial_velocity) settle_speeds(scene, share);
  } catch (const InputError& error) {
    throw_in_scene(scene, error.what());
  }
}

template <int Dim>
void Specimen<Dim>::settle_grid(const scene::Scene& scene, const Share& share)
{
  cells_ = cell_counts<Dim>(scene.grid, size_);
  count_ = location_counts<Dim>(cells_, particles_per_cell_, share.parts);
}

template <int Dim>
void Specimen<Dim>::settle_picture(const scene::Scene& scene, Picture picture, const Share& share)
{
  size_[0] = picture.size[0];
  size_[1] = picture.size[1];
  if constexpr (Dim == 3) size_[2] = scene.specimen.micrograph->depth.value();
  settle_grid(scene, share);

  if constexpr (Dim == 3) {
    if (picture.image.slices > 1) {
      Section<3> stack(scene, std::move(picture), count_, share);
      picture_ = stack.figures();
      source_ = std::make_unique<StackSource>(std::move(stack));
    }
  }
  if (!source_) {
    Section<2> section(scene, std::move(picture), count_.template head<2>(), share);
    picture_ = section.figures();
    const GlobalIndex layers = Dim == 3 ? count_[Dim - 1] : 1;
    picture_->removed *= layers;
    picture_->unconnected *= layers;
    source_ = std::make_unique<PictureSource<Dim>>(std::move(section));
  }
  std::vector<std::int8_t> materials(scene.materials.size());
  std::iota(materials.begin(), materials.end(), std::int8_t(0));
  const std::vector<WindowCount> counts = count_windows<Dim>(
      count_, windows_of(scene), materials.size(),
      [&](Lattice<Dim>& lattice) { source_->fill(lattice); }, share);
  for (const double filled : counts[0].filled)
    particles_of_material_.push_back(GlobalIndex(filled));
  densities_ = densities_of(scene, counts, materials);
}

template <int Dim>
void Specimen<Dim>::settle_shapes(const scene::Scene& scene, const Share& share)
{
  const scene::Specimen& specimen = scene.specimen;
  if (specimen.shapes.empty())
    throw InputError("specimen is empty. Give specimen.micrograph, or specimen.size and .shapes.");
  for (int d = 0; d < Dim; ++d) {
    size_[d] = specimen.size[std::size_t(d)];
    if (!(size_[d] > 0))
      throw InputError(fmt::format("specimen.size[{}] is {} m (must be above 0).", d, size_[d]));
  }
  settle_grid(scene, share);

  auto source = std::make_unique<ShapeSource<Dim>>(scene, size_);
  std::vector<double> found(specimen.shapes.size());
  const std::vector<WindowCount> counts = count_windows<Dim>(
      count_, windows_of(scene), specimen.shapes.size(),
      [&](Lattice<Dim>& lattice) { source->fill(lattice, found); }, share);
  share.sum(found);
  check_found(found);

  std::vector<std::int8_t> material_of_shape;
  particles_of_material_.assign(scene.materials.size(), 0);
  for (std::size_t shape = 0; shape < specimen.shapes.size(); ++shape) {
    const std::int8_t material = source->material(shape);
    material_of_shape.push_back(material);
    const double filled = counts[0].filled[shape];
    if (filled == 0) continue;  // void, or all of it drawn over
    particles_of_material_[std::size_t(material)] += GlobalIndex(filled);
    if (!scene.materials[std::size_t(material)].law->deformable()) continue;
    for (const double component : specimen.shapes[shape].velocity)
      largest_initial_speed_ = std::max(largest_initial_speed_, std::abs(component));
  }
  if (particles() == 0)
    throw InputError("no location is filled: specimen.shapes cut out all they fill. Change them.");
  densities_ = densities_of(scene, counts, material_of_shape);
  source_ = std::move(source);
}

template <int Dim>
void Specimen<Dim>::settle_speeds(const scene::Scene& scene, const Share& share)
{
  constexpr GlobalIndex chunk_locations = 1 << 20;  // held at a time
  double largest = 0;
  for_each_chunk(
      slab(whole(), share.part, share.parts), chunk_locations, [&](const IndexBox<Dim>& chunk) {
        const Lattice<Dim> held = lattice(chunk);
        std::size_t place = 0;
        for_each_index(chunk, [&](const IndexVec<Dim>& at) {
          const std::int8_t material = held.material[place++];
          if (material == held.empty || !scene.materials[std::size_t(material)].law->deformable())
            return;
          std::array<double, Dim> position;
          for (int d = 0; d < Dim; ++d)
            position[std::size_t(d)] = centre(at[d], count_[d]) * size_[d];
          for (int d = 0; d < Dim; ++d) {
            const auto& formula = (*scene.specimen.initial_velocity)[std::size_t(d)];
            const double speed = std::abs(formula(position, 0));
            // What is no number stays.
            if (!std::isnan(largest) && !(speed <= largest)) largest = speed;
          }
        });
      });
  // One entry per part: there is a sum over the parts, and no maximum.
  std::vector<double> of_parts(std::size_t(share.parts));
  of_parts[std::size_t(share.part)] = largest;
  share.sum(of_parts);
  largest_initial_speed_ = *std::ranges::max_element(of_parts);
  for (const double speed : of_parts)
    if (!std::isfinite(speed))
      throw InputError(
          "specimen.initial_velocity is no finite number at some particle. Give formulas that are "
          "one everywhere in the specimen.");
}

template <int Dim>
void Specimen<Dim>::check_found(const std::vector<double>& found) const
{
  const auto lost = std::ranges::find(found, 0.0);
  if (lost == found.end()) return;
  std::string size = fmt::format("{}", size_[0]), count = fmt::format("{}", count_[0]);
  for (int d = 1; d < Dim; ++d) {
    size += fmt::format(" x {}", size_[d]);
    count += fmt::format(" x {}", count_[d]);
  }
  throw InputError(fmt::format(
      "specimen.shapes[{}] contains no particle location of the specimen ({} m, lattice {}). Move "
      "or enlarge it, or refine the grid.",
      lost - found.begin(), size, count));
}

template <int Dim>
GlobalIndex Specimen<Dim>::particles() const
{
  return std::accumulate(particles_of_material_.begin(), particles_of_material_.end(),
                         GlobalIndex(0));
}

template <int Dim>
Lattice<Dim> Specimen<Dim>::lattice(const IndexBox<Dim>& part) const
{
  Lattice<Dim> lattice{count_, part, {}, {}};
  source_->fill(lattice);
  return lattice;
}

template class Specimen<2>;
template class Specimen<3>;

}  // namespace mpm::micrograph
