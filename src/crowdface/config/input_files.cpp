// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/input_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "crowdface/config/config_values.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

void add_image(const fs::path& image, std::vector<fs::path>& files) {
  files.push_back(image);
  for (fs::path& tile : find_tiles(image)) files.push_back(std::move(tile));
}

bool is_head(const fs::path& path) {
  return mesh_format_of(path) == MeshFormat::kObj && !path.filename().string().starts_with('.') &&
         !is_folder(path);
}

}  // namespace

std::vector<fs::path> list_heads(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files = list_files(folder, is_head, &error);
  if (!error) return files;
  throw MissingInput(
      concat("the folder ", quoted(folder.string()), " cannot be read: ", error.message()));
}

std::vector<fs::path> input_files(const Config& config) {
  std::vector<fs::path> files = {config.file};
  const auto add = [&](const fs::path& file) {
    if (!file.empty()) files.push_back(file);
  };
  std::ranges::for_each(config.faces.files, add);
  add(config.shapes.neutral);
  std::ranges::for_each(config.shapes.files, add);
  for (const auto& of_head : config.shapes.of_head) std::ranges::for_each(of_head, add);
  add(config.points);
  add(config.rig);
  add(config.attachments.file);
  for (const Config::Attachment& item : config.attachments.items) add(item.file);
  for (const std::string& mask : config.regions.mask) add_image(mask, files);
  if (config.distance.mask) add_image(*config.distance.mask, files);
  std::ranges::for_each(config.review.files, add);
  add(config.edits);
  if (const auto& sheet = config.output.contact_sheet) add(sheet->compare.file);
  return files;
}

void refuse_path_no_config_can_hold(const fs::path& path) {
  if (is_utf8(path.native()) && !has_control_character(path.native())) return;
  throw UsageError(concat(quoted(path.native()),
                          ": expected a path of UTF-8 text without control characters, which a "
                          "config can name"));
}

void check_paths(const Config& config, Problems& problems) {
  std::vector<fs::path> paths = input_files(config);
  paths.push_back(config.output.directory);
  for (const fs::path& path : paths) {
    std::error_code ignored;
    try {
      refuse_path_no_config_can_hold(fs::absolute(path, ignored));
    } catch (const UsageError& error) {
      problems.add(error);
    }
  }
}

}  // namespace crowdface
