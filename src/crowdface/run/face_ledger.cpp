// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_ledger.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "crowdface/core/contains.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/gallery_page.h"
#include "crowdface/run/attachment_writers.h"
#include "crowdface/run/mesh_judge.h"
#include "crowdface/run/mesh_writers.h"
#include "crowdface/run/own_textures.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// What determines a face's files beside its recipe and `settings`: formats, frame, pictures.
Digest digest_of_output(const Job& job, const FaceExtras& extras) {
  const Config& config = job.config;
  Hasher hasher;
  hasher.add(kFaceFilesVersion).add(kPrepareVersion).add(job.settings);
  hasher.add(config.output.meshes.size());
  for (const MeshFormat format : config.output.meshes) hasher.add(name_of(format));
  if (contains(config.output.meshes, MeshFormat::kUsd)) {
    hasher.add(static_cast<int>(config.output.subdivision));
  }
  if (!job.inputs.shapes.shapes.empty()) hasher.add(kShapesVersion).add(job.inputs.shapes_digest);
  if (!job.inputs.points.empty()) hasher.add(kPointsVersion).add(job.inputs.points_digest);
  if (!job.inputs.rig.empty()) hasher.add(kRigVersion).add(job.inputs.rig.digest);
  if (!job.inputs.attachments.empty()) {
    hasher.add(kAttachmentsVersion).add(job.inputs.attachments.digest);
  }
  if (!job.inputs.levels.empty()) {
    hasher.add(kLevelsVersion);
    for (const MeasuredLevel& level : job.inputs.levels) hasher.add(level.level.share);
  }
  hasher.add(config.faces.units.mm);
  for (const Axis& axis : {config.faces.up, config.faces.front}) {
    hasher.add(axis.index).add(axis.sign);
  }
  if (has_own_textures(job.inputs) && !config.output.meshes.empty()) {
    hasher.add(kTextureVersion).add(job.inputs.textures.digest);
    for (const HeadTextures& maps : job.inputs.maps) {
      hasher.add(static_cast<int>(maps.names.front().kind)).add(maps.digest);
    }
    hasher.add(config.textures.formats.size());
    for (const TextureFormat format : config.textures.formats) hasher.add(static_cast<int>(format));
  }
  if (config.output.faces_per_folder.value_or(0) > 0) hasher.add("numbered folders");
  hasher.add(extras.skin).add(extras.shapes > 0).add(extras.picture).add(extras.preview);
  if (extras.picture) {
    const Config::ContactSheet& sheet = *config.output.contact_sheet;
    hasher.add(sheet.cell).add(sheet.views.size());
    for (const View view : sheet.views) hasher.add(static_cast<int>(view));
    hasher.add(job.inputs.textures.digest);
    for (const HeadTextures& maps : job.inputs.maps) hasher.add(maps.digest);
    if (has_own_textures(job.inputs)) hasher.add(kTextureVersion);
    for (const auto& [material, surface] : config.output.surfaces) {
      hasher.add(material).add(static_cast<int>(surface.kind)).add(surface.colour.has_value());
      for (const std::uint8_t value : surface.colour.value_or(std::array<std::uint8_t, 3>{})) {
        hasher.add(static_cast<int>(value));
      }
    }
  }
  return hasher.digest();
}

std::string item_of(const CastFace& face) {
  return concat("faces/", face.id);
}

Json to_json(const SkinDefects& skin) {
  return {{"compared", skin.local.compared}, {"flipped", skin.local.flipped},
          {"stretch", skin.local.stretch},   {"intersecting", skin.intersecting},
          {"wider_mm", skin.wider_mm},       {"exposed_mm2", skin.exposed_mm2}};
}

/// The line's checksum was right, so it is what `to_json` made; a line of another program's version
/// throws.
SkinDefects noted_skin(const Json& json) {
  SkinDefects skin;
  skin.local.compared = json.at("compared").get<Index>();
  skin.local.flipped = json.at("flipped").get<Index>();
  skin.local.stretch = json.at("stretch").get<double>();
  skin.intersecting = json.at("intersecting").get<Index>();
  skin.wider_mm = json.at("wider_mm").get<double>();
  skin.exposed_mm2 = json.at("exposed_mm2").get<double>();
  return skin;
}

/// How many, if a format or the gallery has them.
std::size_t carried_shapes(const Job& job) {
  const auto holds = [](MeshFormat format) { return format != MeshFormat::kPly; };
  const bool is_carried =
      has_gallery(job.config) || std::ranges::any_of(job.config.output.meshes, holds);
  return is_carried ? job.inputs.shapes.shapes.size() : 0;
}

FaceExtras extras_of(const Job& job) {
  return {job.config.output.contact_sheet.has_value(), has_gallery(job.config),
          skin_is_judged(job.config, job.inputs), carried_shapes(job)};
}

}  // namespace

FaceLedger::FaceLedger(Ledger& ledger, const Job& job, const CrowdDirectory& directory,
                       std::function<void()> recorded)
    : ledger_(ledger),
      job_(job),
      directory_(directory),
      extras_(extras_of(job)),
      recorded_(std::move(recorded)),
      output_(digest_of_output(job, extras_)) {}

Digest FaceLedger::key_of(const CastFace& face) const {
  CastFace shape = face;
  shape.notes = {};  // no file depends on how it was found
  return Hasher().add(output_).add(format_recipe(shape, job_.names, job_.settings)).digest();
}

std::optional<FaceFiles> FaceLedger::done(const CastFace& face) const {
  const auto entry = ledger_.proven(item_of(face), key_of(face));
  if (!entry) return std::nullopt;
  const std::vector<MeshName> names = mesh_names_of(face, job_.config.output.meshes, job_.inputs);
  const std::vector<std::string> own =
      own_file_names(job_.config, job_.inputs, job_.config.output.meshes, face.id);
  const std::size_t pictures = (extras_.picture ? 1U : 0U) + (extras_.preview ? 1U : 0U);
  if (entry->files.size() != names.size() + own.size() + pictures) return std::nullopt;
  FaceFiles files;
  for (std::size_t f = 0; f < names.size(); ++f) {
    files.meshes.push_back({names[f], entry->files[f].content});
  }
  for (std::size_t o = 0; o < own.size(); ++o) {
    files.own.push_back(entry->files[names.size() + o].content);
  }
  if (extras_.picture) files.picture = entry->files[names.size() + own.size()].content;
  if (extras_.preview) files.preview = entry->files.back().content;
  try {
    if (extras_.skin || extras_.shapes > 0) {
      const Json note = Json::parse(entry->note);
      if (extras_.skin) files.skin = noted_skin(note);
      if (extras_.shapes > 0) files.crossing = note.at("crossing").get<std::vector<Index>>();
      if (files.crossing.size() != extras_.shapes) return std::nullopt;
    }
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return files;
}

LedgerEntry FaceLedger::entry_of(const CastFace& face, const FaceFiles& files) const {
  LedgerEntry entry{item_of(face), key_of(face), {}, {}};
  for (const MeshFile& mesh : files.meshes) {
    entry.files.push_back(
        {directory_.relative(mesh_path(directory_, face.id, mesh.name)), mesh.content});
  }
  const std::vector<std::string> own =
      own_file_names(job_.config, job_.inputs, job_.config.output.meshes, face.id);
  for (std::size_t o = 0; o < own.size(); ++o) {
    entry.files.push_back(
        {directory_.relative(directory_.meshes_of(face.id) / own[o]), files.own[o]});
  }
  if (files.picture) {
    entry.files.push_back({directory_.relative(directory_.render(face.id)), *files.picture});
  }
  if (files.preview) {
    entry.files.push_back({directory_.relative(directory_.gallery_face(face.id)), *files.preview});
  }
  Json note;
  if (files.skin) note = to_json(*files.skin);
  if (!files.crossing.empty()) note["crossing"] = files.crossing;
  if (!note.is_null()) entry.note = note.dump();
  return entry;
}

void FaceLedger::record(std::span<const MadeFace> faces) const {
  std::vector<LedgerEntry> entries;
  for (const MadeFace& made : faces) entries.push_back(entry_of(*made.face, made.files));
  ledger_.record_all(std::move(entries));
  for (std::size_t f = 0; f < faces.size(); ++f) recorded_();
}

}  // namespace crowdface
