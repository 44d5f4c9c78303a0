// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_attachments.h"

#include <algorithm>
#include <chrono>
#include <future>

#include "crowdface/cast/attachment_sampling.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/run/casting.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kTexels = 1024;

}  // namespace

EditAttachments::EditAttachments(const Job& job, const std::vector<FacePlan>* crowd)
    : job_(job), crowd_(crowd), surfaces_(kTexels, true) {}

Json EditAttachments::kinds() const {
  Json kinds = Json::object();
  for (const Attachment& item : job_.inputs.attachments.items) {
    kinds[item.kind].push_back(item.name);
  }
  return kinds;
}

std::optional<std::string> EditAttachments::appearance_json(const std::string& name) const {
  const std::size_t plus = std::min(name.find('+'), name.size());
  for (const Attachment& item : job_.inputs.attachments.items) {
    if (item.name != name.substr(0, plus)) continue;
    ColouredAttachment look{&item};
    if (plus < name.size()) look.colour = parse_hair_label(std::string_view(name).substr(plus + 1));
    return shown_.appearance_as_json(look, surfaces_.at(item));
  }
  return std::nullopt;
}

FacePlan EditAttachments::plan_with_attachments(const FacePlan& face,
                                                const std::string& opened_id) const {
  if (crowd_ != nullptr) {
    const auto found = std::ranges::find(*crowd_, opened_id, &FacePlan::id);
    if (found != crowd_->end()) return *found;
  }
  std::vector<FacePlan> alone = {face};
  choose_attachments(attachment_options(job_.config), {}, alone);
  return alone[0];
}

EditAttachments::BindingFuture EditAttachments::binding(const std::string& name) {
  const std::lock_guard lock(mutex_);
  BindingFuture& future = bindings_[name];
  if (future.valid()) return future;
  FacePlan wearer;
  wearer.attachments = {name};
  future = std::async(std::launch::async, [this, wearer] {
             return std::make_unique<const FaceAttachments>(job_.config, job_.inputs,
                                                            std::span(&wearer, 1));
           }).share();
  return future;
}

std::optional<std::vector<PlacedAttachment>> EditAttachments::attachments_of(
    const FacePlan& face, const std::string& opened_id, const Json& chosen,
    const Positions& positions, std::span<const Displacements> moves) {
  const std::vector<Attachment>& items = job_.inputs.attachments.items;
  std::vector<PlacedAttachment> placed;
  if (items.empty()) return placed;
  const FacePlan plan = plan_with_attachments(face, opened_id);
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
  dressed.hair = plan.hair;
  std::vector<BindingFuture> worn;
  std::vector<std::string> names;
  for (const Attachment& item : items) {
    const std::string choice = chosen.value(item.kind, std::string("draw"));
    const bool wears =
        choice == "draw" ? std::ranges::find(drawn, item.name) != drawn.end() : choice == item.name;
    if (!wears) continue;
    worn.push_back(binding(item.name));
    names.push_back(item.name);
  }
  for (std::size_t i = 0; i < worn.size(); ++i) {
    if (worn[i].wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    dressed.attachments = {names[i]};
    for (PlacedAttachment& one : worn[i].get()->attachments_of(dressed, positions, moves)) {
      for (const Displacements& move : one.moves) move.add_to(one.positions);
      placed.push_back(std::move(one));
    }
  }
  return placed;
}

}  // namespace crowdface
