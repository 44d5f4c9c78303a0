// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_ledger.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/settings_digest.h"
#include "crowdface/pictures/gallery_page.h"
#include "crowdface/run/mesh_judge.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Hash of the data that the files of every face depend on: heads, settings, other inputs,
/// algorithm versions.
Digest digest_of_common(const Job& job) {
  const Config& config = job.config;
  const Inputs& inputs = job.inputs;
  Hasher hasher;
  hasher.add(kFaceFilesVersion)
      .add(kPrepareVersion)
      .add(job.settings)
      .add(face_settings_yaml(config));
  hasher.add(config.faces.units.mm);
  for (const Axis& axis : {config.faces.up, config.faces.front}) {
    hasher.add(axis.index).add(axis.sign);
  }
  if (inputs.heads_on_body) hasher.add(kNeckVersion).add(inputs.heads_on_body->digest);
  if (!inputs.shapes.shapes.empty()) hasher.add(kShapesVersion).add(inputs.shapes_digest);
  if (!inputs.points.empty()) hasher.add(kPointsVersion).add(inputs.points_digest);
  if (!inputs.rig.empty()) hasher.add(kRigVersion).add(inputs.rig.digest);
  if (!inputs.attachments.empty()) hasher.add(kAttachmentsVersion).add(inputs.attachments.digest);
  if (!inputs.detail_levels.empty()) hasher.add(kLevelsVersion);
  if (blends_textures(inputs)) hasher.add(kTextureVersion);
  hasher.add(inputs.textures.digest).add(materials_digest(inputs));
  if (!inputs.vertex_colours.empty()) hasher.add(inputs.colours_digest);
  for (const HeadTextures& maps : inputs.other_textures) {
    hasher.add(static_cast<int>(maps.names.front().kind)).add(maps.digest);
  }
  return hasher.digest();
}

std::string item_of(const FacePlan& face) {
  return concat("faces/", face.id);
}

Json to_json(const SkinDefects& skin) {
  return {{"compared", skin.local.compared_triangle_count},
          {"flipped", skin.local.flipped_triangle_count},
          {"stretch", skin.local.stretch_factor},
          {"intersecting", skin.intersecting_triangle_count},
          {"wider_mm", skin.gap_excess_mm},
          {"exposed_mm2", skin.exposed_back_face_mm2}};
}

/// Parses the output of `to_json`. The caller has verified the checksum of the ledger line, so an
/// exception means that another version of the program wrote the line.
SkinDefects parse_skin_defects(const Json& json) {
  SkinDefects skin;
  skin.local.compared_triangle_count = json.at("compared").get<Index>();
  skin.local.flipped_triangle_count = json.at("flipped").get<Index>();
  skin.local.stretch_factor = json.at("stretch").get<double>();
  skin.intersecting_triangle_count = json.at("intersecting").get<Index>();
  skin.gap_excess_mm = json.at("wider_mm").get<double>();
  skin.exposed_back_face_mm2 = json.at("exposed_mm2").get<double>();
  return skin;
}

/// Returns the number of blend shapes that are transferred to each face: 0 unless a mesh format or
/// the gallery shows shapes.
std::size_t transferred_shape_count(const Job& job) {
  const bool is_carried =
      has_gallery(job.config) || any_format(job.config.output.meshes, [](const auto& format) {
        return format.shapes != DataStorage::kNowhere;
      });
  return is_carried ? job.inputs.shapes.shapes.size() : 0;
}

}  // namespace

FaceLedger::FaceLedger(Ledger& ledger, const Job& job, const FaceFileLists& lists,
                       std::function<void()> recorded)
    : ledger_(ledger),
      job_(job),
      lists_(lists),
      recorded_(std::move(recorded)),
      judges_skin_(skin_is_judged(job.config, job.inputs)),
      shape_count_(transferred_shape_count(job)),
      common_digest_(digest_of_common(job)) {}

LedgerEntry FaceLedger::entry_of(const FacePlan& face, const FaceResult& result) const {
  FacePlan recipe = face;
  recipe.notes = {};  // no file depends on the notes of casting or on measurements
  recipe.traits = {};
  Hasher key;
  key.add(common_digest_).add(judges_skin_).add(shape_count_ > 0);
  key.add(format_plan_line(recipe, job_.names, job_.settings));
  LedgerEntry entry{item_of(face), {}, {}, {}};
  const std::vector<FaceFile> files = lists_.all_files(face);
  for (std::size_t f = 0; f < files.size(); ++f) {
    entry.files.push_back({lists_.directory().relative(files[f].path),
                           f < result.file_digests.size() ? result.file_digests[f] : FileDigest{}});
    key.add(entry.files.back().name);
  }
  entry.key = key.digest();
  Json note;
  if (result.skin_defects) note = to_json(*result.skin_defects);
  if (!result.skin_intersections.empty()) note["crossing"] = result.skin_intersections;
  if (!note.is_null()) entry.note = note.dump();
  return entry;
}

std::optional<FaceResult> FaceLedger::recorded_result(const FacePlan& face) const {
  const LedgerEntry wanted = entry_of(face, {});
  const auto entry = ledger_.find_verified(wanted.item, wanted.key);
  if (!entry || entry->files.size() != wanted.files.size()) return std::nullopt;
  FaceResult result;
  for (const LedgerEntry::File& file : entry->files) result.file_digests.push_back(file.content);
  try {
    if (judges_skin_ || shape_count_ > 0) {
      const Json note = Json::parse(entry->note);
      if (judges_skin_) result.skin_defects = parse_skin_defects(note);
      if (shape_count_ > 0)
        result.skin_intersections = note.at("crossing").get<std::vector<Index>>();
      if (result.skin_intersections.size() != shape_count_) return std::nullopt;
    }
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return result;
}

void FaceLedger::record(std::span<const MadeFace> faces) const {
  std::vector<LedgerEntry> entries;
  for (const MadeFace& made : faces) entries.push_back(entry_of(*made.face, made.result));
  ledger_.record_all(std::move(entries));
  for (std::size_t f = 0; f < faces.size(); ++f) recorded_();
}

}  // namespace crowdface
