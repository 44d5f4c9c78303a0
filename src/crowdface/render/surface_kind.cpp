// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/surface_kind.h"

#include <array>
#include <string>
#include <utility>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

// The first matching word decides. Words of hidden parts come first, because such parts are often
// named after the eye.
constexpr auto kWords = std::to_array<std::pair<std::string_view, SurfaceKind>>({
    {"lash", SurfaceKind::kHidden},     {"lacrimal", SurfaceKind::kHidden},
    {"tear", SurfaceKind::kHidden},     {"occlusion", SurfaceKind::kHidden},
    {"eyeblend", SurfaceKind::kHidden}, {"eye_blend", SurfaceKind::kHidden},
    {"shell", SurfaceKind::kHidden},    {"cornea", SurfaceKind::kHidden},
    {"meniscus", SurfaceKind::kHidden}, {"eyelid", SurfaceKind::kSkin},
    {"eyebrow", SurfaceKind::kSkin},    {"eyesocket", SurfaceKind::kSkin},
    {"eye_socket", SurfaceKind::kSkin}, {"iris", SurfaceKind::kIris},
    {"pupil", SurfaceKind::kIris},      {"sclera", SurfaceKind::kEye},
    {"eyeball", SurfaceKind::kEye},     {"eyewhite", SurfaceKind::kEye},
    {"eye_white", SurfaceKind::kEye},   {"eye white", SurfaceKind::kEye},
    {"teeth", SurfaceKind::kTeeth},     {"tooth", SurfaceKind::kTeeth},
    {"gum", SurfaceKind::kGums},        {"tongue", SurfaceKind::kGums},
});

}  // namespace

SurfaceKind surface_kind_of_material(std::string_view material_name) {
  const std::string name = lower_case(material_name);
  for (const auto& [word, kind] : kWords) {
    if (name.find(word) != std::string::npos) return kind;
  }
  // A plain "Eye" or "eyes_left" is an eyeball.
  return name.starts_with("eye") ? SurfaceKind::kEye : SurfaceKind::kSkin;
}

}  // namespace crowdface
