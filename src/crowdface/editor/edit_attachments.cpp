// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_attachments.h"

#include <algorithm>
#include <chrono>
#include <future>

#include "crowdface/cast/attachment_draw.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/run/casting.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kTexels = 1024;

}  // namespace

EditAttachments::EditAttachments(const Job& job, const std::vector<FacePlan>* crowd)
    : job_(job),
      crowd_(crowd),
      bound_(std::async(std::launch::async,
                        [this] {
                          return std::make_unique<const FaceAttachments>(job_.config, job_.inputs);
                        })
                 .share()),
      surfaces_(kTexels, true) {}

Json EditAttachments::kinds() const {
  Json kinds = Json::object();
  for (const Attachment& item : job_.inputs.attachments.items) {
    kinds[item.kind].push_back(item.name);
  }
  return kinds;
}

std::optional<std::string> EditAttachments::look(const std::string& name) const {
  const std::size_t plus = std::min(name.find('+'), name.size());
  for (const Attachment& item : job_.inputs.attachments.items) {
    if (item.name != name.substr(0, plus)) continue;
    AttachmentLook look{&item};
    if (plus < name.size()) look.colour = parse_hair_label(std::string_view(name).substr(plus + 1));
    return shown_.look(look, surfaces_.at(item));
  }
  return std::nullopt;
}

FacePlan EditAttachments::drawn_for(const FacePlan& face, const std::string& opened) const {
  if (crowd_ != nullptr) {
    const auto found = std::ranges::find(*crowd_, opened, &FacePlan::id);
    if (found != crowd_->end()) return *found;
  }
  std::vector<FacePlan> alone = {face};
  draw_attachments(attachment_draw(job_.config), {}, alone);
  return alone[0];
}

bool EditAttachments::are_bound() const {
  return bound_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::vector<PlacedAttachment> EditAttachments::attachments_of(const FacePlan& face,
                                                              const std::string& opened,
                                                              const Json& chosen,
                                                              const Positions& positions) const {
  const std::vector<Attachment>& items = job_.inputs.attachments.items;
  if (items.empty()) return {};
  const FacePlan plan = drawn_for(face, opened);
  const std::vector<std::string>& drawn = plan.attachments;
  const Json known = kinds();
  for (const auto& [kind, choice] : chosen.items()) {
    const std::string name = choice.is_string() ? choice.get<std::string>() : "";
    const bool is_word = name == "draw" || name == "none";
    if (known.contains(kind) &&
        (is_word || std::find(known[kind].begin(), known[kind].end(), name) != known[kind].end())) {
      continue;
    }
    throw UsageError(
        concat("wears: expected draw, none or the name of an attachment for each kind, found ",
               quoted(concat(kind, ": ", name))));
  }
  FacePlan dressed = face;
  dressed.attachments.clear();
  dressed.hair = plan.hair;
  for (const Attachment& item : items) {
    const std::string choice = chosen.value(item.kind, std::string("draw"));
    const bool wears =
        choice == "draw" ? std::ranges::find(drawn, item.name) != drawn.end() : choice == item.name;
    if (wears) dressed.attachments.push_back(item.name);
  }
  return bound_.get()->attachments_of(dressed, positions);
}

}  // namespace crowdface
