#pragma once
#include <mpm/simulation/preparation.hpp>

namespace mpm {

/// What a specialist would look at first when a run failed at this particle (its id, or none), as a
/// sentence with a remedy; empty where nothing stands out. The same on every rank.
template <int Dim>
std::string likely_cause(const Preparation<Dim>& preparation, GlobalIndex particle);

}  // namespace mpm
