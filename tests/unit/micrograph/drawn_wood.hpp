#pragma once
/// Files of the wood generator, and a drawn picture as walls and lumens.

#include <mpm/micrograph/anatomy_drawing.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace mpm::micrograph::anatomy {

inline std::filesystem::path wood_file(const std::string& name)
{
  return std::filesystem::path(MPM_INPUTS_DIR) / "wood" / name;
}

inline std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::string text_of(const std::filesystem::path& file)
{
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Lattice of wall (true) and lumen: area-weighted mean gray >= 150, straight from the definition.
struct Walls {
  int nx, ny;
  std::vector<bool> wall;

  Walls(const Drawing& picture, int columns, int rows) : nx(columns), ny(rows)
  {
    const double sx = double(picture.width) / nx, sy = double(picture.height) / ny;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        double sum = 0, area = 0;
        for (int q = int(j * sy); q < std::min(picture.height, int((j + 1) * sy) + 1); ++q)
          for (int p = int(i * sx); p < std::min(picture.width, int((i + 1) * sx) + 1); ++p) {
            const double x = std::min((i + 1) * sx, p + 1.0) - std::max(i * sx, double(p));
            const double y = std::min((j + 1) * sy, q + 1.0) - std::max(j * sy, double(q));
            if (x <= 0 || y <= 0) continue;
            sum += x * y * picture(p, q);
            area += x * y;
          }
        wall.push_back(sum / area >= 150);
      }
  }

  double density(double from = 0, double to = 1) const
  {
    long filled = 0, all = 0;
    for (int j = 0; j < ny; ++j)
      for (int i = int(std::lround(from * nx)); i < int(std::lround(to * nx)); ++i) {
        filled += wall[std::size_t(j) * nx + i];
        ++all;
      }
    return double(filled) / all;
  }

  /// Number of the edge-connected piece that each location belongs to.
  std::vector<int> pieces() const
  {
    std::vector<int> piece(wall.size(), -1);
    int count = 0;
    for (std::size_t start = 0; start < wall.size(); ++start) {
      if (piece[start] >= 0) continue;
      std::vector<std::size_t> front{start};
      piece[start] = count;
      while (!front.empty()) {
        const std::size_t at = front.back();
        front.pop_back();
        const int i = int(at % nx), j = int(at / nx);
        const auto visit = [&](int a, int b) {
          if (a < 0 || a >= nx || b < 0 || b >= ny) return;
          const std::size_t to = std::size_t(b) * nx + a;
          if (piece[to] >= 0 || wall[to] != wall[start]) return;
          piece[to] = count;
          front.push_back(to);
        };
        visit(i + 1, j), visit(i - 1, j), visit(i, j + 1), visit(i, j - 1);
      }
      ++count;
    }
    return piece;
  }
};

}  // namespace mpm::micrograph::anatomy
