// SPDX-License-Identifier: Apache-2.0
// The method once more, as plainly as it can be written: loops over lists, no filter, no matrices,
// no code of the program. Tests hold what the program makes against it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace crowdface::reference {

using Point = std::array<double, 3>;
using Points = std::vector<Point>;

/// An OBJ file's `v`, `vt` and `f` lines, indices from 0.
struct Obj {
  Points vertices;
  std::vector<std::array<double, 2>> uvs;
  std::vector<std::vector<std::size_t>> faces;
  std::vector<std::vector<std::optional<std::size_t>>> face_uvs;
};
Obj read_obj(const std::filesystem::path& path);

/// Eq. 1: who is averaged with whom.
struct Filter {
  std::vector<std::vector<std::size_t>> rings;  ///< edge-neighbours of every vertex
  std::vector<bool> stays;                      ///< vertices that no iteration moves
  bool lazy = false;                            ///< (x + Wx)/2 in place of Wx
};
Filter make_filter(const Obj& mesh, bool fixed_boundary, bool lazy);

/// W^L x, one iteration after the other.
Points smooth(const Filter& filter, Points x, std::uint64_t level);

/// An image as rows of pixels, first row on top.
struct Picture {
  std::size_t width = 0, height = 0, channels = 0;
  std::vector<double> values;
};
/// A mask: one picture under the number 0, or UDIM tiles by their numbers.
using Mask = std::map<int, Picture>;

/// α_k of every vertex (design §5).
std::vector<std::vector<double>> masks_at_vertices(const Obj& mesh, const std::vector<Mask>& masks,
                                                   std::size_t regions);

/// Everything that Eq. 7 needs beside a plan line.
struct Heads {
  std::map<std::string, Points> positions;
  Filter filter;
  std::vector<std::string> regions;
  std::vector<std::vector<double>> alpha;
};

/// Eq. 7 with the numbers of a plan line: Σ_k α_k [S_L B + e Σ_i ω̂_i (C_i − S_L C_i)].
Points blend(const Heads& heads, const nlohmann::json& line);

/// The paper's cubics (§5.1): c_0 … c_3 of every coordinate, S̃_L x = x + Σ_p c_p (L/L_max)^p,
/// fitted by least squares to the levels round(L_max·(j/40)²).
struct Cubics {
  std::uint64_t max_level = 1;
  std::vector<std::array<Point, 4>> coefficients;
};
Cubics fit_cubics(const Filter& filter, const Points& x, std::uint64_t max_level);
Points smooth(const Cubics& cubics, Points x, std::uint64_t level);

/// Eq. 7 with approximated levels (Eqs. 5 and 6).
Points blend(const Heads& heads, const std::map<std::string, Cubics>& cubics,
             const nlohmann::json& line);

/// Eqs. 3 and 4: weights of a position by name. `sources` lend detail; with `printed` the target's
/// weight is only counted, else it takes part. `most` of the largest beside it are kept.
std::map<std::string, double> weights_at_position(
    const std::vector<std::pair<std::string, std::array<double, 2>>>& anchors,
    const std::string& target, const std::vector<std::string>& sources, std::array<double, 2> m,
    bool printed, std::optional<std::size_t> most);

/// Largest distance of two vertices that belong together.
double largest_difference(const Points& a, const Points& b);

/// Area-weighted normals of vertices (Newell), of unit length.
Points vertex_normals(const Obj& mesh, const Points& positions);

}  // namespace crowdface::reference
