// SPDX-License-Identifier: Apache-2.0
// A new face: the smoothed shape of one head with a good part of the detail of another.
#include <iostream>

#include "crowdface/crowdface.h"

using namespace crowdface;

int main(int argc, char** argv) try {
  if (argc != 4) throw UsageError("usage: blend_two_heads TARGET.obj SOURCE.obj OUT.obj");
  const ObjFile target = read_obj(argv[1]), source = read_obj(argv[2]);
  const std::string difference = first_difference(target.topology, source.topology);
  if (!difference.empty()) throw InvalidInput(difference);
  const HeadSet heads = {
      target.topology, target.uvs, {{"target", target.positions}, {"source", source.positions}}};

  RegionRecipe whole;
  whole.weights = {{0, 0.25}, {1, 0.75}};  // a quarter of the target's own detail stays
  whole.iterations = 1000;                 // the more, the larger the shapes that count as detail
  const SmoothingOperator smoothing(build_adjacency(heads.topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions face = blend_exact(heads, ChebyshevFilter(smoothing, target.positions),
                                     whole_head_weights(heads.topology), {0, {whole}});
  write_obj_like(target, heads.topology, face, argv[3]);
  std::cout << argv[3] << ": a face of " << face.rows() << " vertices\n";
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return static_cast<int>(error.code());
}
