// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/complaints.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "crowdface/core/text.h"

namespace crowdface {

void Complaints::add(const YamlPlace& place, std::string message, ExitCode exit_code) {
  complaints_.push_back({place, std::move(message), exit_code});
}

void Complaints::add_at(const YamlNode& node, const std::string& message, ExitCode exit_code) {
  if (node.kind == YamlNode::Kind::kRefused) return;
  add(node.place, node.path.empty() ? message : concat(node.path, ": ", message), exit_code);
}

std::nullopt_t Complaints::add_mismatch(const YamlNode& node, const std::string& expected) {
  add_at(node, concat("expected ", expected, ", found ", describe(node)));
  return std::nullopt;
}

bool Complaints::expect_list(const YamlNode& node, const std::string& expected) {
  if (node.kind != YamlNode::Kind::kList) add_mismatch(node, expected);
  return node.kind == YamlNode::Kind::kList;
}

bool Complaints::expect_map(const YamlNode& node, const std::string& expected) {
  if (node.kind != YamlNode::Kind::kMap) add_mismatch(node, expected);
  return node.kind == YamlNode::Kind::kMap;
}

void Complaints::report_to(Problems& problems) const {
  // largest number of complaints in a report; a longer list would push the first problems off the
  // screen
  constexpr std::size_t kMaxReportedComplaints = 100;
  std::vector<Complaint> sorted = complaints_;
  const auto key = [](const Complaint& c) {
    return std::tuple(c.place.line == 0, c.place.line, c.place.column);
  };
  std::ranges::stable_sort(sorted, {}, key);
  for (std::size_t i = 0; i < std::min(sorted.size(), kMaxReportedComplaints); ++i) {
    problems.add(sorted[i].exit_code, concat(sorted[i].place.text(), ": ", sorted[i].message));
  }
  if (sorted.size() > kMaxReportedComplaints) {
    problems.add(ExitCode::kUsage,
                 concat(sorted[kMaxReportedComplaints].place.text(), ": and ",
                        sorted.size() - kMaxReportedComplaints, " more problems from here on"));
  }
}

}  // namespace crowdface
