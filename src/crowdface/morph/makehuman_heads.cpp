// SPDX-License-Identifier: Apache-2.0
#include "crowdface/morph/makehuman_heads.h"

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/morph/makehuman_controls.h"

namespace crowdface {
namespace {

constexpr double kCentimetresPerUnit = 10;

std::vector<std::string> read_target_names(const std::filesystem::path& file) {
  std::vector<std::string> names;
  try {
    const auto root = nlohmann::json::parse(read_file(file));
    for (const auto& [name, groups] : root.at("targets").items()) names.push_back(name);
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput(
        concat(file.string(), ": expected MakeHuman's list of targets: ", error.what()));
  }
  return names;
}

}  // namespace

MakeHumanHeads::MakeHumanHeads(const std::filesystem::path& package)
    : mesh_(read_makehuman_mesh(package / "public/data/models/human_full_size.json")),
      targets_(package / "public/data/targets/targets.bin",
               read_target_names(package / "src/json/targets/target-list.json"),
               mesh_.file_vertices),
      eyes_(vertices_of_material(mesh_.head.topology, mesh_.materials, {"eyeball"})) {
  for (const std::string& name : makehuman_target_names()) {
    if (!targets_.has(name)) {
      throw InvalidInput(concat((package / "src/json/targets/target-list.json").string(),
                                ": expected a target ", quoted(name), ", found none"));
    }
  }
  neutral_ = {mesh_.head.topology, in_frame(mesh_.head.positions), mesh_.head.uvs};
  const double origin = mean_of(mesh_.head.positions, eyes_).y();
  heights_ = {kCentimetresPerUnit * (mesh_.heights.eyes - origin),
              kCentimetresPerUnit * (mesh_.heights.mouth - origin)};
}

/// Bodies differ in height: heads are brought together at the eyes.
Positions MakeHumanHeads::in_frame(const Positions& decimetres) const {
  const Eigen::RowVector3d origin = mean_of(decimetres, eyes_);
  return kCentimetresPerUnit * (decimetres.rowwise() - origin);
}

Positions MakeHumanHeads::positions(std::uint64_t seed, std::uint64_t index) const {
  Positions head = mesh_.head.positions;
  const MakeHumanPerson person = draw_makehuman_person(seed, index);
  for (const TargetWeight& target : makehuman_targets(person, seed, index)) {
    targets_.add(target, mesh_.rows, head);
  }
  return in_frame(head);
}

std::optional<HeadPerson> MakeHumanHeads::person(std::uint64_t seed, std::uint64_t index) const {
  const MakeHumanPerson person = draw_makehuman_person(seed, index);
  return HeadPerson{person.male, person.years};
}

}  // namespace crowdface
