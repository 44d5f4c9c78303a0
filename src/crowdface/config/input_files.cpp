// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/input_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/list_files.h"
#include "crowdface/core/text.h"
#include "crowdface/core/utf8.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

void add_image(const fs::path& image, std::vector<fs::path>& files) {
  files.push_back(image);
  for (fs::path& tile : find_tiles(image)) files.push_back(std::move(tile));
}

void add_shapes(const Config::Shapes& shapes, std::vector<fs::path>& files) {
  if (!shapes.neutral.empty()) files.push_back(shapes.neutral);
  const auto add = [&](const std::vector<fs::path>& some) {
    for (const fs::path& file : some) {
      if (!file.empty()) files.push_back(file);
    }
  };
  add(shapes.files);
  for (const std::vector<fs::path>& of_head : shapes.of_head) add(of_head);
}

bool is_head(const fs::path& path) {
  return mesh_format_of(path) == MeshFormat::kObj && !path.filename().string().starts_with('.') &&
         !is_folder(path);
}

bool is_plain_text(std::string_view text) {
  return is_utf8(text) && std::ranges::none_of(text, [](char c) {
           return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
         });
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
  files.insert(files.end(), config.faces.files.begin(), config.faces.files.end());
  add_shapes(config.shapes, files);
  if (!config.points.empty()) files.push_back(config.points);
  if (!config.rig.empty()) files.push_back(config.rig);
  const Config::Attachments& attachments = config.attachments;
  if (!attachments.file.empty()) files.push_back(attachments.file);
  for (const Config::Attachment& item : attachments.items) files.push_back(item.file);
  for (const std::string& mask : config.regions.mask) add_image(mask, files);
  if (config.distance.mask) add_image(*config.distance.mask, files);
  files.insert(files.end(), config.review.files.begin(), config.review.files.end());
  const auto& sheet = config.output.contact_sheet;
  if (sheet && !sheet->compare.file.empty()) files.push_back(sheet->compare.file);
  return files;
}

void refuse_path_no_config_can_hold(const fs::path& path) {
  if (is_plain_text(path.native())) return;
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
