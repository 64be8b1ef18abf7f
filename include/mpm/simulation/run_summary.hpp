#pragma once
#include <mpm/simulation/exact_solution.hpp>
#include <mpm/simulation/run.hpp>

#include <filesystem>

namespace mpm {

/// What a run was and what came out of it, as FILE. On one rank. Throws FileError.
template <int Dim>
void write_summary(const Preparation<Dim>& preparation, const RunResult& result,
                   const ExactSolution<Dim>& exact, const std::filesystem::path& file);

}  // namespace mpm
