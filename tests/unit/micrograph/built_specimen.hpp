#pragma once
/// Specimens of scenes, on one part and on several at a time.

#include <mpm/micrograph/specimen.hpp>

#include <algorithm>
#include <barrier>
#include <functional>
#include <span>
#include <thread>
#include <vector>

namespace mpm::micrograph::test {

template <int Dim = 2>
Specimen<Dim> built(const scene::Scene& scene, const Share& share = {})
{
  return Specimen<Dim>(scene, read_picture(scene), share);
}

/// Index of the material at every location, x fastest.
template <int Dim = 2>
std::vector<std::int8_t> materials_of(const scene::Scene& scene)
{
  const Specimen<Dim> specimen = built<Dim>(scene);
  return specimen.lattice(specimen.whole()).material;
}

/// Runs `action(share)` on so many parts, one thread each. Sums are made in the order of the parts.
inline void on_parts(int parts, const std::function<void(const Share&)>& action)
{
  std::barrier<> meet(parts);
  std::vector<std::span<double>> given(static_cast<std::size_t>(parts));
  std::vector<double> total;
  const auto run = [&](int part) {
    const auto sum = [&, part](std::span<double> values) {
      given[std::size_t(part)] = values;
      meet.arrive_and_wait();
      if (part == 0) {
        total.assign(values.size(), 0.0);
        for (const std::span<double> each : given)
          for (std::size_t k = 0; k < total.size(); ++k) total[k] += each[k];
      }
      meet.arrive_and_wait();
      std::ranges::copy(total, values.begin());
      meet.arrive_and_wait();
    };
    action(Share{part, parts, sum});
  };
  std::vector<std::jthread> threads;
  for (int part = 0; part < parts; ++part) threads.emplace_back(run, part);
}

}  // namespace mpm::micrograph::test
