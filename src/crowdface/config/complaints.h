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
  /// A problem of a config, and the place in the config where the problem occurs.
  struct Complaint {
    YamlPlace place;
    std::string message;
    ExitCode exit_code;
  };

  /// Adds a complaint about the value at this place of the config.
  void add(const YamlPlace& place, std::string message, ExitCode exit_code = ExitCode::kUsage);
  /// Adds the complaint "PATH: MESSAGE" at the node's place in the file, where PATH is the node's
  /// path of keys. Adds nothing if the node has the kind kRefused, because such a node already has
  /// a complaint.
  void add_at(const YamlNode& node, const std::string& message,
              ExitCode exit_code = ExitCode::kUsage);
  /// Adds the complaint "PATH: expected EXPECTED, found …" at a node's place in the file.
  ///
  /// \return `nullopt`, so that a function that reads a value can return the result of this call.
  std::nullopt_t add_mismatch(const YamlNode& node, const std::string& expected);
  /// Returns whether the node is a list (expect_list) or a mapping (expect_map). If not, adds the
  /// complaint of add_mismatch.
  ///
  /// \param expected  what the complaint names as the expected value, such as "a list of tags".
  bool expect_list(const YamlNode& node, const std::string& expected);
  bool expect_map(const YamlNode& node, const std::string& expected);

  bool empty() const { return complaints_.empty(); }
  std::size_t size() const { return complaints_.size(); }
  const std::vector<Complaint>& all() const { return complaints_; }

  /// Reports the first 100 complaints, sorted by line and column. Complaints about the command line
  /// come last. If there are more than 100, one final problem says how many are not shown.
  void report_to(Problems& problems) const;

 private:
  std::vector<Complaint> complaints_;
};

}  // namespace crowdface
