// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/ict_heads.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxModes = 1000;
constexpr double kLimit = 2;  // largest weight of a mode, in standard deviations

std::vector<fs::path> identity_files(const fs::path& folder) {
  std::vector<fs::path> files;
  while (files.size() < kMaxModes) {
    const fs::path file = folder / concat("identity", zero_padded(files.size(), 3), ".obj");
    if (!is_file(file)) break;
    files.push_back(file);
  }
  if (files.empty()) {
    throw MissingInput(concat((folder / "identity000.obj").string(),
                              ": expected the model's first identity mode, found no such file"));
  }
  return files;
}

}  // namespace

IctHeads::IctHeads(const fs::path& checkout)
    : file_(read_obj(checkout / "FaceXModel/generic_neutral_mesh.obj")),
      neutral_{file_.topology, file_.positions, file_.uvs} {
  const std::vector<fs::path> files = identity_files(checkout / "FaceXModel");
  modes_.resize(files.size());
  parallel_for_each(files.size(), [&](std::size_t i) {
    const ObjFile mode = read_obj(files[i]);
    const std::string difference = first_difference(neutral_.topology, mode.topology);
    if (!difference.empty()) {
      refuse_file(mode.path,
                  concat("not the same mesh as ", file_.path.string(), ": ", difference));
    }
    modes_[i] = mode.positions - neutral_.positions;
  });
}

Positions IctHeads::positions(std::uint64_t seed, std::uint64_t index) const {
  Positions head = neutral_.positions;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const double weight =
        std::clamp(random_normal({seed, index, concat("ict/mode/", i)}), -kLimit, kLimit);
    head += weight * modes_[i];
  }
  return head;
}

std::optional<HeadPerson> IctHeads::person(std::uint64_t /*seed*/, std::uint64_t /*index*/) const {
  return std::nullopt;
}

FeatureHeights IctHeads::heights() const {
  const auto height = [&](const std::vector<std::string>& words) {
    const auto vertices = vertices_of_material(neutral_.topology, file_.materials, words);
    if (vertices.empty()) {
      refuse_file(file_.path,
                  concat("expected a material called like ", join(words), ", found none"));
    }
    return mean_of(neutral_.positions, vertices).y();
  };
  return {height({"Sclera"}), height({"Teeth"})};
}

}  // namespace crowdface
