// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/input_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/core/utf8.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

void add_image(const fs::path& image, std::vector<fs::path>& files) {
  files.push_back(image);
  for (fs::path& tile : find_tiles(image)) files.push_back(std::move(tile));
}

bool is_plain_text(std::string_view text) {
  return is_utf8(text) && std::none_of(text.begin(), text.end(), [](char c) {
           return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
         });
}

}  // namespace

std::vector<fs::path> input_files(const Config& config) {
  std::vector<fs::path> files = {config.file};
  files.insert(files.end(), config.faces.files.begin(), config.faces.files.end());
  for (const std::string& mask : config.regions.mask) add_image(mask, files);
  if (config.distance.mask) add_image(*config.distance.mask, files);
  files.insert(files.end(), config.review.files.begin(), config.review.files.end());
  const auto& sheet = config.output.contact_sheet;
  if (sheet && !sheet->compare.file.empty()) files.push_back(sheet->compare.file);
  return files;
}

void refuse_to_write_over_inputs(const Config& config, const fs::path& path) {
  for (const fs::path& input : input_files(config)) {
    std::error_code ignored;
    if (!fs::equivalent(input, path, ignored)) continue;
    throw UsageError(concat(path.string(), ": is an input of this job (", input.string(),
                            ") and is not written over; choose another name"));
  }
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
