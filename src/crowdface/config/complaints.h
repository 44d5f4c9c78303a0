// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/yaml_node.h"
#include "crowdface/core/problems.h"

namespace crowdface {

/// What is wrong with a config, gathered in any order and told in that of the file.
class Complaints {
 public:
  struct Complaint {
    YamlPlace place;
    std::string what;
    ExitCode kind;
  };

  void add(const YamlPlace& place, std::string what, ExitCode kind = ExitCode::kUsage);
  /// "PATH: WHAT" at the node; silent about a node that a complaint was made of already.
  void about(const YamlNode& node, const std::string& what, ExitCode kind = ExitCode::kUsage);
  /// "PATH: expected EXPECTED, found …" at the node. \return nothing, for who reads a value to return.
  std::nullopt_t expected(const YamlNode& node, const std::string& expected);
  /// Whether the node is a list, or a mapping; the same complaint if not.
  bool expect_list(const YamlNode& node, const std::string& what);
  bool expect_map(const YamlNode& node, const std::string& what);

  bool empty() const { return complaints_.empty(); }
  std::size_t size() const { return complaints_.size(); }
  const std::vector<Complaint>& list() const { return complaints_; }

  /// Hands over the first hundred by line and column; those of the command line come last.
  void tell(Problems& problems) const;

 private:
  std::vector<Complaint> complaints_;
};

}  // namespace crowdface
