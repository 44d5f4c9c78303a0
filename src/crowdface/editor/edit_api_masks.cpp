// SPDX-License-Identifier: Apache-2.0
// Masks that are painted on the editor's page.
#include "crowdface/core/error.h"
#include "crowdface/editor/binary_answer.h"
#include "crowdface/editor/edit_api.h"
#include "crowdface/editor/request_values.h"

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
      "masks were painted: save them, name the images under regions.mask in the config and open "
      "the "
      "editor again; then what is saved is what the config makes");
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
  for (const auto& file : painting_.save(folder_.path())) files.push_back(file.string());
  return json_answer({{"files", files}});
}

}  // namespace crowdface
