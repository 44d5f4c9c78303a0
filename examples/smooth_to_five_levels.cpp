// SPDX-License-Identifier: Apache-2.0
// A mesh smoothed by 10 to 10000 iterations, all in one pass.
#include <iostream>

#include "crowdface/crowdface.h"

using namespace crowdface;

int main(int argc, char** argv) try {
  if (argc != 3) throw UsageError("usage: smooth_to_five_levels IN.obj OUT_DIR");
  const ObjFile mesh = read_obj(argv[1]);
  const SmoothingOperator smoothing(build_adjacency(mesh.topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const ChebyshevFilter filter(smoothing, mesh.positions);

  const std::vector<std::uint64_t> levels = {10, 50, 250, 1000, 10000};
  const std::vector<Positions> smoothed = smooth(filter, mesh.positions, levels);
  std::filesystem::create_directories(argv[2]);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto file =
        std::filesystem::path(argv[2]) / ("smooth_" + std::to_string(levels[i]) + ".obj");
    write_obj_like(mesh, mesh.topology, smoothed[i], file);
    const double farthest = (smoothed[i] - mesh.positions).rowwise().norm().maxCoeff();
    std::cout << file.string() << ": moved by up to " << farthest << " units\n";
  }
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return static_cast<int>(error.code());
}
