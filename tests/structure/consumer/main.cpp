// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include <crowdface/crowdface.h>
#include <crowdface/io/image.h>

int main(int /*argc*/, char** argv) {
  using namespace crowdface;
  const ObjFile mesh = read_obj(argv[1]);
  const SmoothingOperator smoothing(build_adjacency(mesh.topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions smoothed =
      smooth(ChebyshevFilter(smoothing, mesh.positions), mesh.positions, 100);
  const std::uint8_t grey[] = {0, 128, 255, 7};
  const bool encoded = encode_png(2, 2, 1, grey).starts_with("\x89PNG");
  Problems problems;
  const bool refused = !read_config("no_such_file.yaml", {}, problems);
  std::cout << "crowdface " << kVersion << ", " << smoothed.rows() << " vertices smoothed\n";
  return smoothed.allFinite() && encoded && refused && problems.code() == ExitCode::kMissingInput
             ? 0
             : 1;
}
