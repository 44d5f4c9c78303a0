// SPDX-License-Identifier: Apache-2.0
// Masks that are painted on the editor's page.
#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/editor/edit_api.h"
#include "crowdface/editor/regions_in_config.h"
#include "crowdface/page/binary_answer.h"
#include "crowdface/page/request_values.h"

namespace crowdface {

HttpAnswer EditApi::painted_masks() const {
  const std::vector<float> masks = painting_.masks();
  BinaryAnswer answer;
  answer.add("alpha", std::span(masks));
  return {200, "application/octet-stream", answer.bytes()};
}

void EditApi::require_masks_of_config() const {
  if (!painting_.painted()) return;
  throw UsageError(
      "masks were painted that the config does not name yet: press \"Use masks\"; then what is "
      "saved "
      "is what the config makes");
}

HttpAnswer EditApi::paint_masks(const HttpRequest& request, const std::string&) {
  const Json body = body_of(request);
  const std::lock_guard lock(building_);
  painting_.stroke(body);
  return painted_masks();
}

HttpAnswer EditApi::undo_masks(const HttpRequest&, const std::string&) {
  const std::lock_guard lock(building_);
  painting_.undo();
  return painted_masks();
}

HttpAnswer EditApi::save_masks(const HttpRequest&, const std::string&) {
  const std::lock_guard lock(building_);
  Json files = Json::array();
  for (const auto& file : painting_.save(painting_.regions({}), unused_masks())) {
    files.push_back(file.string());
  }
  return json_answer({{"files", files}});
}

std::filesystem::path EditApi::unused_masks() const {
  const std::vector<std::string>& used = session_.job().config.regions.mask;
  const bool first_is_used = std::ranges::any_of(used, [](const std::string& mask) {
    return std::filesystem::path(mask).filename().string().starts_with("masks");
  });
  return folder_.path() / (first_is_used ? "other_masks.png" : "masks.png");
}

HttpAnswer EditApi::use_regions(const HttpRequest& request, const std::string& rest) {
  require_own_config();
  require_no_run();
  const Json body = body_of(request);
  {
    const std::lock_guard lock(building_);
    const PaintedRegions regions = painting_.regions(body);
    put_regions(session_.job().config.file, regions.names, painting_.save(regions, unused_masks()));
    painting_.forget();
  }
  return open_again(request, rest);
}

}  // namespace crowdface
