// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/contains.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/mesh_format.h"

namespace crowdface {

/// What the file of points that follow a face is called, after the face's id and a '+'.
inline constexpr const char* kFollowingPoints = "points.json";

/// Where things lie in a crowd's folder (docs/crowd-directory.md).
struct CrowdDirectory {
  std::filesystem::path root;
  /// Meshes, renders and the gallery's scripts lie in numbered subfolders of so many faces; 0: in none.
  std::uint64_t faces_per_folder = 0;

  std::filesystem::path config() const { return root / "config.yaml"; }
  std::filesystem::path plan() const { return root / "plan.jsonl"; }
  /// The hidden founders of families, in the form of the plan.
  std::filesystem::path founders() const { return root / "founders.jsonl"; }
  /// The faces that reviews rejected, in the form of the plan.
  std::filesystem::path rejected() const { return root / "rejected.jsonl"; }
  /// The reviews that the crowd is a function of, in their order, and number `number`, from 1.
  std::filesystem::path reviews() const { return root / "reviews"; }
  std::filesystem::path review(std::size_t number) const;
  std::vector<std::filesystem::path> kept_reviews() const;
  std::filesystem::path table() const { return root / "crowd.csv"; }
  std::filesystem::path casting() const { return root / "casting.json"; }
  std::filesystem::path report() const { return root / "report.json"; }
  std::filesystem::path timings() const { return root / "timings.json"; }
  std::filesystem::path log() const { return root / "crowdface.log"; }
  std::filesystem::path ledger() const { return root / "ledger.jsonl"; }
  std::filesystem::path lock() const { return root / ".crowdface.lock"; }
  /// Which job the plan is of, for shards that take it as it is: see planned_faces.
  std::filesystem::path planned() const { return root / "planned.json"; }
  /// How far a shard is, for those who watch.
  std::filesystem::path progress(const Shard& shard) const {
    return of_shard(root / "progress.json", shard);
  }
  std::vector<std::filesystem::path> all_progress() const {
    return of_all_shards(root / "progress.json");
  }
  /// What runs the crowd on other machines: task scripts and what tasks said.
  std::filesystem::path submitted() const { return root / "submit"; }
  /// A shard's own; those above if the shard is the whole crowd.
  std::filesystem::path log(const Shard& shard) const { return of_shard(log(), shard); }
  std::filesystem::path ledger(const Shard& shard) const { return of_shard(ledger(), shard); }
  std::filesystem::path lock(const Shard& shard) const { return of_shard(lock(), shard); }
  /// The ledgers and logs of all shards that have written some, by name.
  std::vector<std::filesystem::path> shard_ledgers() const { return of_all_shards(ledger()); }
  std::vector<std::filesystem::path> shard_logs() const { return of_all_shards(log()); }
  /// Those of all shards, then the crowd's own; they need not be there.
  std::vector<std::filesystem::path> ledgers() const;
  std::filesystem::path meshes() const { return root / "meshes"; }
  std::filesystem::path renders() const { return root / "renders"; }
  /// One USD layer that references those of all faces.
  std::filesystem::path stage() const { return root / "crowd.usda"; }
  std::filesystem::path sheets() const { return root / "sheets"; }
  /// \param part  a level of detail, a shape, or all shapes (no face's id holds the '+' between)
  std::filesystem::path mesh(const std::string& id, MeshFormat format,
                             const std::string& part = {}) const;
  /// Arrays that say how positions alone (MeshFormat::kPoints) form faces.
  std::filesystem::path topology() const { return meshes() / "topology"; }
  /// Where a face's meshes lie, and below them its textures, which its material file names.
  std::filesystem::path meshes_of(const std::string& id) const { return meshes() / folder_of(id); }
  /// The way from a face's meshes to what all share, material files, say: "..", or nothing.
  std::string shared_from_mesh() const { return faces_per_folder > 0 ? ".." : ""; }
  std::filesystem::path render(const std::string& id) const {
    return renders() / folder_of(id) / (id + ".png");
  }
  std::filesystem::path head_render(const std::string& name) const {
    return renders() / "heads" / (name + ".png");
  }
  std::filesystem::path founder_render(const std::string& family) const {
    return renders() / "founders" / (family + ".png");
  }
  std::filesystem::path likeness() const { return root / "likeness.json"; }
  std::filesystem::path gallery() const { return root / "gallery"; }
  std::filesystem::path gallery_faces() const { return gallery() / "data/faces"; }
  std::filesystem::path gallery_face(const std::string& id) const {
    return gallery_faces() / folder_of(id) / (id + ".js");
  }
  /// Recipes of a large crowd, as many a script as faces a subfolder.
  std::filesystem::path gallery_pages() const { return gallery() / "data/pages"; }
  std::filesystem::path gallery_head(const std::string& name) const {
    return gallery() / "data/heads" / (name + ".js");
  }
  std::filesystem::path gallery_attachment(const std::string& name) const {
    return gallery() / "data/attachments" / (name + ".js");
  }
  /// The name that the ledger has for a file of the crowd.
  std::string relative(const std::filesystem::path& file) const {
    return file.lexically_relative(root).generic_string();
  }
  /// Sheet number `page`, from 1; as many in a subfolder as faces.
  std::filesystem::path sheet(std::size_t page) const;
  /// "012": the subfolder of a face by the number that its id ends with; empty: there are none.
  std::filesystem::path folder_of(std::string_view id) const;
};

/// A folder and its numbered subfolders, which are there.
std::vector<std::filesystem::path> with_numbered_folders(const std::filesystem::path& folder);

/// Files of a crowd never land outside its folder, not by a link either.
/// \throws CannotCreate if `folder`, in the crowd's folder, is such a link.
void refuse_folder_elsewhere(const CrowdDirectory& directory, const std::filesystem::path& folder);

/// The ids that the plan in a folder names; lines that cannot be read, or whose id is no file's name, name
/// none.
std::vector<std::string> ids_in_plan(const CrowdDirectory& directory);

/// The gallery's page, in its folder; what it shows lies in `data` below.
inline constexpr std::array<std::string_view, 4> kGalleryPageFiles = {
    "index.html", "gallery.js", "gallery.css", "three.LICENSE.txt"};
inline bool is_gallery_page_file(const std::filesystem::path& path) {
  return contains(kGalleryPageFiles, path.filename().string());
}

/// Where the material files of an attachment and the textures that those name lie, from the meshes that all
/// share.
inline std::filesystem::path attachment_folder(const std::string& name) {
  return std::filesystem::path("attachments") / name;
}

/// The item of the ledger whose files are contact sheets and all that is made with them.
inline constexpr std::string_view kSheetsItem = "sheets";

/// The contact sheets in the folder: those of families, whose names may be anything, by the ledger
/// alone, the others by their names.
std::vector<std::filesystem::path> crowd_sheets(const CrowdDirectory& directory);

/// What is made with the sheets: pictures of heads and founders, and the gallery but for faces' meshes.
/// \throws IoError if a folder cannot be read.
std::vector<std::filesystem::path> files_beside_sheets(const CrowdDirectory& directory);

/// \throws MissingInput if the folder is no crowd's.
void require_crowd(const CrowdDirectory& directory);

enum class Replace { kRefuse, kForce };

/// What tells one crowd's folder from another's.
struct CrowdConfig {
  std::string text;                  ///< that will stand in config.yaml
  std::vector<std::string> reviews;  ///< what stands in each, beside it
  /// The first key in which the text of another config.yaml differs; nothing if it is the same crowd's.
  std::function<std::optional<std::string>(const std::string& other)> difference;
};

/// Refuses a folder that could not be opened, before any heavy work, and changes nothing.
/// \throws UsageError if it holds another crowd; CannotCreate if it cannot be written to.
void check_crowd_directory(const CrowdDirectory& directory, const CrowdConfig& config,
                           Replace replace);

/// Makes the folder ready for this config's crowd: creates it, refuses one that holds another
/// config's crowd, or (kForce) removes that crowd's files first, and no others.
/// \throws UsageError if the folder holds another crowd; CannotCreate, IoError.
void open_crowd_directory(const CrowdDirectory& directory, const CrowdConfig& config,
                          Replace replace);

}  // namespace crowdface
