// SPDX-License-Identifier: Apache-2.0
// What the editor saves and its page sends: the file of the key `edits`, one recipe, and marks.
#include <cstdlib>

#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/config/edited_entries.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("edits");
  static const auto config_file = folder.write(
      "crowd.yaml",
      "schema: 1\ncrowd: {name: mob, count: 3}\nfaces: {directory: heads, units: cm}\n"
      "regions: {names: [top, low], mask: mask.png}\nedits: edits.yaml\n"
      "recipes: [{id: mine, target: bob, regions: {all: {weights: {ann: 1}, smoothness: 0.3}}}]\n");
  const auto text = crowdface::fuzz::text_of(data, size);
  folder.write("edits.yaml", text);
  crowdface::Problems problems;
  const auto config = crowdface::read_config(config_file, {}, problems);
  if (config.has_value() != problems.empty()) std::abort();
  folder.write("edits.yaml", "{}");
  crowdface::Problems none, of_recipe;
  static const auto plain = crowdface::read_config(config_file, {}, none);
  const auto recipe = crowdface::parse_manual_recipe(text, "recipe", plain.value(), of_recipe);
  if (recipe.has_value() != of_recipe.empty()) std::abort();
  // What is written is read back.
  if (recipe) {
    const std::string written = crowdface::format_manual_recipe(*recipe, *plain);
    crowdface::Problems again;
    if (!crowdface::parse_manual_recipe(written, "recipe", *plain, again)) std::abort();
  }
  return 0;
}
