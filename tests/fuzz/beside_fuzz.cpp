// SPDX-License-Identifier: Apache-2.0
// The files that a config names: tags of heads, a folder of attachments, a table of measurements.
#include <cstdlib>
#include <string>

#include "crowdface/config/config_reader.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

namespace {

/// Reads a config with this section; `file`, which it names, gets the text.
void read_with(const std::string& file, const std::string& section, std::string_view text) {
  static const crowdface::fuzz::JobFolder folder("beside");
  folder.write("wardrobe/bob.obj", "v 0 0 0\n");
  const auto config_file = folder.write("crowd.yaml",
                                        "schema: 1\ncrowd: {name: mob, count: 3}\n"
                                        "faces: {directory: heads, units: cm}\n" +
                                            section);
  const auto beside = folder.write(file, text);
  crowdface::Problems problems;
  const auto config = crowdface::read_config(config_file, {}, problems);
  if (config.has_value() != problems.empty()) std::abort();
  // What is accepted can be written and read again.
  if (config) {
    crowdface::Problems again;
    crowdface::read_config_text(crowdface::effective_config(*config, config_file.parent_path()),
                                config_file, {}, again);
    if (!again.empty()) std::abort();
  }
  std::filesystem::remove(beside);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto text = crowdface::fuzz::text_of(data, size);
  read_with("heads/tags.yaml", "", text);
  read_with("wardrobe/attachments.yaml", "attachments: {from: wardrobe}\n", text);
  read_with("measured.csv", "population: measured.csv\n", text);
  return 0;
}
