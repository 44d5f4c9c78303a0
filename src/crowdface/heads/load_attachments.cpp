// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/load_transferred.h"
#include "crowdface/heads/read_heads.h"

namespace crowdface {
namespace {

Positions fitted_mesh(const Config& config, const Inputs& inputs) {
  const Config::Attachments& asked = config.attachments;
  const auto read = [&](const std::filesystem::path& file) {
    return read_positions(file, inputs.head_set.topology, config.faces.files.front().string());
  };
  if (!asked.file.empty()) return read(asked.file);
  if (!asked.fitted_head)
    return inputs.heads_on_body ? inputs.heads_on_body->mean_before_placement
                                : mean_head(inputs.head_set);
  const auto head = static_cast<std::size_t>(*asked.fitted_head);
  // Attachments are fitted to the positions that the head's file stores. If rigid alignment or the
  // neck has moved the loaded head, read these positions from the file again.
  if (config.faces.align == Align::kRigid || inputs.heads_on_body)
    return read(config.faces.files[head]);
  return inputs.head_set.heads[head].positions;
}

Attachment item_of(const Config::Attachment& asked, HeadFile read) {
  Attachment item{asked.name, asked.kind, asked.moves, std::move(read.file), read.text_digest, {}};
  item.file.topology = read.mesh->topology;
  item.file.uvs = read.mesh->uvs;
  item.tint = asked.tint;
  item.file.corner_normals = read.mesh->corner_normals;
  item.materials = find_material_files(item.file.material_path(), item.file.material_libraries);
  return item;
}

/// Rejects an attachment that lies far from the head or is much larger than the head. The unit or
/// the coordinate frame of such an attachment is probably wrong.
void check_place(const Attachment& item, const Positions& head) {
  constexpr double kFarthest = 0.5, kLargest = 4;  // multiples of the head's diagonal
  const Eigen::RowVector3d low = head.colwise().minCoeff(), high = head.colwise().maxCoeff();
  const Positions& own = item.file.positions;
  const Eigen::RowVector3d own_low = own.colwise().minCoeff(), own_high = own.colwise().maxCoeff();
  const double diagonal = (high - low).norm();
  const double size = (own_high - own_low).norm();
  const Eigen::RowVector3d middle = (own_high + own_low) / 2;
  const Eigen::RowVector3d off = (low - middle).cwiseMax(middle - high).cwiseMax(0.0);
  if (size <= kLargest * diagonal && off.norm() <= kFarthest * diagonal) return;
  refuse_file(item.file.path,
              concat("expected a mesh in the place and unit of the head that it was fitted to; ",
                     "the head is ", format_fixed(diagonal, 2), " units across, this mesh is ",
                     format_fixed(size, 2), ", and its centre is ", format_fixed(off.norm(), 2),
                     " outside the head's bounding box"));
}

Digest digest_of_attachments(const AttachmentSet& set) {
  Hasher hasher;
  hasher.add_array(numbers_of(set.fitted_head_positions));
  for (const Attachment& item : set.items) {
    hasher.add(item.name).add(static_cast<int>(item.moves)).add(item.text_digest);
    if (item.tint != Tint::kNone) hasher.add(static_cast<int>(item.tint));
    for (const MaterialFile& file : item.materials.files) {
      throw_if_interrupted();
      hasher.add(file.destination.generic_string()).add(hash_file(file.source).digest);
    }
  }
  return hasher.digest();
}

}  // namespace

std::size_t AttachmentSet::index(const std::string& name) const {
  const auto found = std::ranges::find(items, name, &Attachment::name);
  require(found != items.end(), "attachments: none is called ", name);
  return static_cast<std::size_t>(found - items.begin());
}

std::string ColouredAttachment::name() const {
  return colour ? concat(item->name, '+', label()) : item->name;
}

ColouredAttachment AttachmentSet::coloured(const std::string& name,
                                           const std::optional<HairColour>& hair) const {
  const Attachment& item = at(name);
  if (item.tint == Tint::kNone || !hair) return {&item};
  return {&item, hair_colour_for(*hair, item.tint)};
}

std::vector<ColouredAttachment> AttachmentSet::attachments_of(const FacePlan& face) const {
  std::vector<ColouredAttachment> worn;
  for (const std::string& name : face.attachments) worn.push_back(coloured(name, face.hair));
  return worn;
}

std::vector<ColouredAttachment> AttachmentSet::attachments_of(
    std::span<const FacePlan> faces) const {
  std::map<std::string, ColouredAttachment> known;
  for (const FacePlan& face : faces) {
    for (const ColouredAttachment& coloured : attachments_of(face))
      known.emplace(coloured.name(), coloured);
  }
  std::vector<ColouredAttachment> all;
  for (const auto& [name, one] : known) all.push_back(one);
  return all;
}

void load_attachments(const Config& config, const CacheFolder& cache, Inputs& inputs,
                      Problems& problems) {
  const std::vector<Config::Attachment>& asked = config.attachments.items;
  if (asked.empty()) return;
  AttachmentSet set;
  const std::size_t before = problems.size();
  try {
    set.fitted_head_positions = fitted_mesh(config, inputs);
  } catch (const RecoverableError& error) {
    problems.add(error);
    return;
  }
  std::vector<std::filesystem::path> paths;
  for (const Config::Attachment& item : asked) paths.push_back(item.file);
  std::vector<HeadFile> files;
  for (auto& file : read_mesh_files(paths, "attachments", cache, problems, Winding::kAsItIs)) {
    if (file) files.push_back(std::move(*file));
  }
  cache_heads(files, cache);
  if (problems.size() > before) return;
  std::vector<std::optional<Attachment>> items(asked.size());
  std::vector<std::optional<Error>> errors(asked.size());
  parallel_for_each(asked.size(), [&](std::size_t i) {
    throw_if_interrupted();
    try {
      items[i] = item_of(asked[i], std::move(files[i]));
      check_place(*items[i], set.fitted_head_positions);
    } catch (const RecoverableError& error) {
      errors[i] = error;
    }
  });
  for (const auto& error : errors) {
    if (error) problems.add(*error);
  }
  if (problems.size() > before) return;
  for (std::optional<Attachment>& item : items) {
    for (const std::string& text : item->materials.warnings) {
      inputs.warn(concat(text, " (attachment ", item->name, ")"));
    }
    set.items.push_back(std::move(*item));
  }
  const auto& meshes = config.output.meshes;
  const bool have_files = any_format(
      meshes, [](const auto& format) { return format.attachments != DataStorage::kNowhere; });
  if (!meshes.empty() && !have_files) {
    inputs.warn(
        "output.meshes writes only NumPy arrays, which cannot hold attachments: the faces are "
        "written without them");
  }
  set.digest = digest_of_attachments(set);
  inputs.attachments = std::move(set);
}

}  // namespace crowdface
