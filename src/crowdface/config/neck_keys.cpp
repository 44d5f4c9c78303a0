// SPDX-License-Identifier: Apache-2.0
// The config section `neck`.
#include "crowdface/config/config_keys.h"

namespace crowdface {
namespace {

using Neck = Config::Neck;

constexpr double kMaxFalloffMm = 1000;

Codec<std::filesystem::path> existing_file(const std::string& expected) {
  return restricted(path(expected),
                    [](const std::filesystem::path& file, const YamlNode& node,
                       ConfigDraft& draft) { return expect_file(node, file, draft); });
}

void read_like(const YamlNode& node, Neck& neck, ConfigDraft& draft) {
  neck.uses_mean_neck = is_word(node, "mean");
  if (!neck.uses_mean_neck) neck.neck_head = head().read(node, draft);
}

std::string write_like(const Neck& neck, const WriteContext& context) {
  if (neck.uses_mean_neck) return "mean";
  return neck.neck_head ? context.head(*neck.neck_head) : "";
}

const Keys<Neck>& neck_keys() {
  static const Keys<Neck> keys = {
      key("body", &Neck::body, existing_file("a mesh file")),
      Key<Neck>{"like", read_like, write_like}.with_accepted_values("head, or `mean`"),
      key("rim", &Neck::rim, existing_file("a text file of vertex numbers")),
      key("body_rim", &Neck::body_rim, existing_file("a text file of vertex numbers")),
      key("falloff", &Neck::falloff_mm, positive_length(kMaxFalloffMm)),
      key("body_texture", &Neck::body_texture, existing_file("an image file")),
      word_key("show_body", &Neck::show_body),
      word_key("write_body", &Neck::write_body)};
  return keys;
}

void read_neck(const YamlNode& node, Config& config, ConfigDraft& draft) {
  config.neck.uses_mean_neck = is_word(node, "mean");
  if (config.neck.uses_mean_neck || is_word(node, "none")) return;
  if (!draft.complaints.expect_map(
          node,
          "none, mean, or a mapping with the keys body, like, rim, body_rim, falloff, "
          "body_texture, show_body, write_body")) {
    return;
  }
  const std::size_t before = draft.complaints.size();
  read_keys(node, neck_keys(), config.neck, draft);
  if (draft.complaints.size() > before) return;
  const bool has_like = node.find("like") != nullptr;
  if (has_like == !config.neck.body.empty()) {
    draft.complaints.add_at(node, "expected either body (a mesh file) or like (a head, or mean)");
  }
  const bool needs_body = config.neck.needs_body_mesh() || !config.neck.body_rim.empty();
  if (needs_body && config.neck.body.empty()) {
    draft.complaints.add_at(
        node, "body_rim, body_texture, show_body and write_body need body (a mesh file)");
  }
}

std::string write_neck(const Config& config, const WriteContext& context) {
  if (!config.neck.is_set()) return "";
  return yaml_block_map(write_keys(neck_keys(), config.neck, context));
}

}  // namespace

Key<Config> neck_key() {
  return Key<Config>{"neck", read_neck, write_neck}.with_nested_keys(neck_keys());
}

}  // namespace crowdface
