// SPDX-License-Identifier: Apache-2.0
// How far apart two heads are: over the face, one moved rigidly onto the other.
#include <iostream>

#include "crowdface/crowdface.h"

using namespace crowdface;

int main(int argc, char** argv) try {
  if (argc != 3) throw UsageError("usage: distance_between_heads A.obj B.obj");
  const ObjFile a = read_obj(argv[1]), b = read_obj(argv[2]);
  const std::string difference = first_difference(a.topology, b.topology);
  if (!difference.empty()) throw InvalidInput(difference);

  const Components components = find_components(build_adjacency(a.topology));
  const Axis front = {2, +1};  // heads look along +Z
  const std::vector<double> areas =
      compared_vertex_areas(a.topology, components, a.positions, ComparedArea::kFront, front);
  const double centimetres = face_distance(a.positions, b.positions, areas);
  std::cout << centimetres * mm_per(LengthUnit::kCentimetre) << " mm\n";
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return static_cast<int>(error.code());
}
