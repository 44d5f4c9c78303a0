// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/attachment_draw.h"

#include <algorithm>
#include <array>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// One of a kind, or none. \param drawn  two numbers from 0 to 1
std::size_t draw_one(const AttachmentDraw& draw, const std::string& kind,
                     const std::vector<std::string>& tags, const std::array<double, 2>& drawn) {
  const auto none = draw.none.find(kind);
  if (none != draw.none.end() && drawn[0] < none->second) return kNone;
  const auto may_wear = [&](const AttachmentItem& item) {
    return item.kind == kind && std::all_of(item.tags.begin(), item.tags.end(),
                                            [&](const auto& tag) { return contains(tags, tag); });
  };
  double sum = 0;
  for (const AttachmentItem& item : draw.items) sum += may_wear(item) ? item.share : 0;
  double left = drawn[1] * sum;
  std::size_t last = kNone;
  for (std::size_t i = 0; i < draw.items.size(); ++i) {
    if (!may_wear(draw.items[i]) || draw.items[i].share <= 0) continue;
    last = i;
    if (left < draw.items[i].share) return i;
    left -= draw.items[i].share;
  }
  return last;
}

}  // namespace

std::vector<std::string> draw_attachments(const AttachmentDraw& draw, const CastFace& face) {
  const std::vector<std::string>& tags = draw.tags[static_cast<std::size_t>(face.recipe.target)];
  std::vector<std::string> kinds;
  std::vector<bool> worn(draw.items.size(), false);
  for (const AttachmentItem& item : draw.items) {
    if (contains(kinds, item.kind)) continue;
    kinds.push_back(item.kind);
    const std::string purpose = face.index ? concat("attachment/", item.kind)
                                           : concat("attachment/", item.kind, '/', face.id);
    const std::size_t one =
        draw_one(draw, item.kind, tags, random_pair({draw.seed, face.index.value_or(0), purpose}));
    if (one != kNone) worn[one] = true;
  }
  for (std::size_t i = 0; i < worn.size(); ++i) {
    if (!worn[i]) continue;
    for (std::size_t j = 0; j < worn.size(); ++j) {
      const std::vector<std::string>& excluded = draw.items[i].excludes;
      const bool taken =
          contains(excluded, draw.items[j].name) || contains(excluded, draw.items[j].kind);
      if (i != j && taken) worn[j] = false;
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < worn.size(); ++i) {
    if (worn[i]) names.push_back(draw.items[i].name);
  }
  return names;
}

}  // namespace crowdface
