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
#include "crowdface/crowd/replace.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/mesh_format.h"

namespace crowdface {

/// End of the name of a face's points file, ID+points.json. This file holds the points that move
/// with the face's mesh.
inline constexpr const char* kFacePointsFileSuffix = "points.json";

/// Paths of the files in a crowd's folder (docs/crowd-directory.md).
struct CrowdDirectory {
  std::filesystem::path root;
  /// Number of faces in each numbered subfolder of the meshes, the renders and the gallery's
  /// scripts; 0: no subfolders.
  std::uint64_t faces_per_folder = 0;

  std::filesystem::path config() const { return root / "config.yaml"; }
  std::filesystem::path plan() const { return root / "plan.jsonl"; }
  /// The founders of families, in the format of the plan. Founders are hidden faces from which the
  /// members of a family are made.
  std::filesystem::path founders() const { return root / "founders.jsonl"; }
  /// The faces that reviews rejected, in the format of the plan.
  std::filesystem::path rejected() const { return root / "rejected.jsonl"; }
  /// The folder with copies of the reviews that the crowd depends on.
  std::filesystem::path reviews() const { return root / "reviews"; }
  /// Path of the copy of a review.
  /// \param number  position in the order of the reviews, counted from 1.
  std::filesystem::path review(std::size_t number) const;
  /// The existing review files: review(1), review(2), … up to the first number without a file.
  std::vector<std::filesystem::path> stored_reviews() const;
  /// The table of all faces, see crowd_table.h.
  std::filesystem::path table() const { return root / "crowd.csv"; }
  /// Statistics of casting.
  std::filesystem::path casting() const { return root / "casting.json"; }
  std::filesystem::path report() const { return root / "report.json"; }
  std::filesystem::path timings() const { return root / "timings.json"; }
  std::filesystem::path log() const { return root / "crowdface.log"; }
  std::filesystem::path ledger() const { return root / "ledger.jsonl"; }
  std::filesystem::path lock() const { return root / ".crowdface.lock"; }
  /// A file with a hash that identifies the job of the plan. A shard uses a plan only if the shard
  /// belongs to the same job; see read_planned_faces.
  std::filesystem::path plan_marker() const { return root / "planned.json"; }
  /// File with the progress of a shard, for `crowdface status` and other observers.
  std::filesystem::path progress(const Shard& shard) const {
    return shard_path(root / "progress.json", shard);
  }
  /// The existing progress files of all shards, sorted by name.
  std::vector<std::filesystem::path> progress_files() const {
    return existing_shard_paths(root / "progress.json");
  }
  /// Folder with the scripts and logs of the tasks that run on other machines.
  std::filesystem::path cluster_task_folder() const { return root / "submit"; }
  // The next three functions return the path of a shard's own log, ledger or lock. If the shard is
  // the whole crowd, they return the path of the crowd's log, ledger or lock.
  std::filesystem::path log(const Shard& shard) const { return shard_path(log(), shard); }
  std::filesystem::path ledger(const Shard& shard) const { return shard_path(ledger(), shard); }
  std::filesystem::path lock(const Shard& shard) const { return shard_path(lock(), shard); }
  /// The existing ledgers of all shards, sorted by name.
  std::vector<std::filesystem::path> shard_ledgers() const {
    return existing_shard_paths(ledger());
  }
  /// The existing logs of all shards, sorted by name.
  std::vector<std::filesystem::path> shard_logs() const { return existing_shard_paths(log()); }
  /// The existing ledgers of all shards, then the ledger of the whole crowd, which need not exist.
  std::vector<std::filesystem::path> ledgers() const;
  std::filesystem::path meshes() const { return root / "meshes"; }
  std::filesystem::path renders() const { return root / "renders"; }
  /// One USD layer that references the layers of all faces.
  std::filesystem::path stage() const { return root / "crowd.usda"; }
  std::filesystem::path sheets() const { return root / "sheets"; }
  /// Path of a face's mesh file, such as meshes/market_0007+LOD1.glb.
  /// \param part  a level of detail ("LOD1"), a shape ("jawOpen"), or "shapes"; empty: the whole
  ///              face. '+' separates the id from the part, because no face's id contains '+'.
  std::filesystem::path mesh(const std::string& id, MeshFormat format,
                             const std::string& part = {}) const;
  /// Folder of arrays that define the polygons for mesh files that contain only positions
  /// (MeshFormat::kPoints).
  std::filesystem::path topology() const { return meshes() / "topology"; }
  /// Folder with the meshes of a face. Subfolders hold the textures that the face's material file
  /// names.
  std::filesystem::path meshes_of(const std::string& id) const {
    return meshes() / numbered_subfolder(id);
  }
  /// Relative path from the folder of a face's meshes to the folder of files that all faces share
  /// (such as material files): ".." or empty.
  std::string path_from_mesh_to_shared() const { return faces_per_folder > 0 ? ".." : ""; }
  /// The image with all views of a face.
  std::filesystem::path render(const std::string& id) const {
    return renders() / numbered_subfolder(id) / (id + ".png");
  }
  std::filesystem::path head_render(const std::string& name) const {
    return renders() / "heads" / (name + ".png");
  }
  std::filesystem::path founder_render(const std::string& family) const {
    return renders() / "founders" / (family + ".png");
  }
  /// The nearest faces of each face, see likeness_file.h.
  std::filesystem::path likeness() const { return root / "likeness.json"; }
  std::filesystem::path gallery() const { return root / "gallery"; }
  /// Folder of the scripts from which the gallery reads the meshes of faces.
  std::filesystem::path gallery_faces() const { return gallery() / "data/faces"; }
  std::filesystem::path gallery_face(const std::string& id) const {
    return gallery_faces() / numbered_subfolder(id) / (id + ".js");
  }
  /// Folder of scripts from which the gallery reads the recipes of a large crowd. Each script holds
  /// the recipes of `faces_per_folder` faces.
  std::filesystem::path gallery_pages() const { return gallery() / "data/pages"; }
  std::filesystem::path gallery_head(const std::string& name) const {
    return gallery() / "data/heads" / (name + ".js");
  }
  std::filesystem::path gallery_attachment(const std::string& name) const {
    return gallery() / "data/attachments" / (name + ".js");
  }
  /// Path of a file relative to the crowd's folder. Ledgers list files by this relative path.
  std::string relative(const std::filesystem::path& file) const {
    return file.lexically_relative(root).generic_string();
  }
  /// Path of sheet number `page`, counted from 1. Each numbered subfolder holds `faces_per_folder`
  /// sheets.
  std::filesystem::path sheet(std::size_t page) const;
  /// Name of the subfolder for the files of a face, such as "012", computed from the number at the
  /// end of the face's id. Empty if the crowd has no subfolders.
  std::filesystem::path numbered_subfolder(std::string_view id) const;
};

/// Returns a folder followed by the existing numbered subfolders of this folder.
std::vector<std::filesystem::path> folder_and_numbered_subfolders(
    const std::filesystem::path& folder);

/// Makes sure that crowdface does not write a crowd's files outside the crowd's folder.
/// \throws CannotCreate if `folder`, a folder of the crowd, is a link that leads out of the crowd's
///         folder.
void refuse_link_out_of_crowd(const CrowdDirectory& directory, const std::filesystem::path& folder);

/// The ids in the plan of a crowd's folder. Skips lines that cannot be read or whose id is not a
/// valid file name.
std::vector<std::string> ids_in_plan(const CrowdDirectory& directory);

/// Names of the files of the gallery's page, which are in the gallery's folder. The page reads the
/// content to show from the subfolder `data`.
inline constexpr std::array<std::string_view, 4> kGalleryPageFiles = {
    "index.html", "gallery.js", "gallery.css", "three.LICENSE.txt"};
inline bool is_gallery_page_file(const std::filesystem::path& path) {
  return contains(kGalleryPageFiles, path.filename().string());
}

/// Folder with the material files of an attachment and the textures that these files name. The path
/// is relative to the folder of meshes.
/// \param colour  text from colour_label, or empty.
inline std::filesystem::path attachment_folder(const std::string& name,
                                               const std::string& colour = {}) {
  const std::filesystem::path folder = std::filesystem::path("attachments") / name;
  return colour.empty() ? folder : folder / colour;
}

/// Name of the ledger item of the contact sheets. The item also lists all files that are made
/// together with the sheets.
inline constexpr std::string_view kSheetsItem = "sheets";

/// The contact sheets in the folder. Looks up the sheets of families in the ledger, because these
/// sheets have arbitrary names. Recognises other sheets by their names.
std::vector<std::filesystem::path> crowd_sheets(const CrowdDirectory& directory);

/// The files that are made together with the contact sheets: images of heads and founders, and the
/// files of the gallery except the meshes of faces.
/// \throws IoError if a folder cannot be read.
std::vector<std::filesystem::path> files_made_together_with_sheets(const CrowdDirectory& directory);

/// Checks that the folder is the folder of a crowd. \throws MissingInput if not.
void require_crowd(const CrowdDirectory& directory);

/// A crowd's config, for comparison with the config.yaml that is already in a folder.
struct CrowdConfig {
  std::string text;                  ///< content to write to config.yaml
  std::vector<std::string> reviews;  ///< content to write to each review file
  /// Returns the keys in which another config.yaml differs from this config; no keys if the other
  /// config.yaml describes the same crowd.
  std::function<std::vector<std::string>(const std::string& other)> differences;
  /// one per review: the content of the review file as this run read it
  std::vector<std::string> original_reviews = {};
  /// Whether to rename the existing folder of reviews to a name with the date.
  bool renames_review_folder = false;
};

/// Checks whether open_crowd_directory would succeed, but changes nothing. For use before any heavy
/// work.
/// \throws UsageError if the folder holds another crowd; CannotCreate if the folder is not
///         writable.
void check_crowd_directory(const CrowdDirectory& directory, const CrowdConfig& config,
                           Replace replace);

/// Prepares the folder for this crowd. Creates the folder if necessary. If the folder holds another
/// crowd, refuses the folder or (with kForce) removes the files of that crowd. Never removes
/// reviews or other files that a person wrote.
/// \throws UsageError if the folder holds another crowd, or reviews that this run did not read;
///         CannotCreate, IoError.
void open_crowd_directory(const CrowdDirectory& directory, const CrowdConfig& config,
                          Replace replace);

}  // namespace crowdface
