// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/yaml_node.h"
#include "crowdface/core/problems.h"

namespace crowdface {

/// Collects the problems of a config in any order and reports them in the order of the file.
class Complaints {
 public:
  struct Complaint {
    YamlPlace place;
    std::string what;
    ExitCode kind;
  };

  void add(const YamlPlace& place, std::string what, ExitCode kind = ExitCode::kUsage);
  /// Adds "PATH: WHAT" at the node, unless the node is already refused (Kind::kRefused).
  void add_at(const YamlNode& node, const std::string& what, ExitCode kind = ExitCode::kUsage);
  /// Adds "PATH: expected EXPECTED, found …" at the node.
  /// \return `nullopt`, so that a function that reads a value can return this call.
  std::nullopt_t expected(const YamlNode& node, const std::string& expected);
  /// Returns whether the node is a list (or a mapping). If not, adds the complaint "expected WHAT".
  bool expect_list(const YamlNode& node, const std::string& what);
  bool expect_map(const YamlNode& node, const std::string& what);

  bool empty() const { return complaints_.empty(); }
  std::size_t size() const { return complaints_.size(); }
  const std::vector<Complaint>& list() const { return complaints_; }

  /// Reports the first 100 complaints by line and column. Complaints about the command line come
  /// last. If there are more, one final problem states how many.
  void report_to(Problems& problems) const;

 private:
  std::vector<Complaint> complaints_;
};

}  // namespace crowdface
