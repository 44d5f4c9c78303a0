// SPDX-License-Identifier: Apache-2.0
// A small job from end to end: heads, masks and a config in a folder, and the comparison of what
// comes out with the plain computation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/run/generate.h"

#include "support/bowl_heads.h"
#include "support/reference.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {

/// What the config of a small crowd says; all else is fixed.
struct SmallCrowd {
  Bowl bowl = {};
  std::size_t heads = 4;
  std::size_t regions = 0;  ///< 0: none; more than three take two images
  bool udim = false;        ///< the masks are sets of tiles
  bool alpha = false;       ///< the masks have an alpha channel too
  std::string boundary = "fixed", operator_kind = "umbrella", normalization = "partition";
  std::string units = "cm", levels = "exact";
  std::string smoothing_limit = "max_iterations: 60";
  std::string sampling = "{smoothness: [0, 1], extrapolation: [0.8, 1.3], max_sources: 3}";
  std::string contact_sheet = "none";
  std::string parts = "none";  ///< the plain computation blends all as skin
  std::string more = {};       ///< further keys at the root
  int count = 4;
  int seed = 11;

  std::vector<std::string> region_names() const;
};

/// A small crowd's inputs on disk.
class SmallCrowdFolder {
 public:
  /// Writes heads, masks and config.yaml; the crowd goes to out.
  explicit SmallCrowdFolder(const SmallCrowd& crowd);

  /// Writes config.yaml again, with the same inputs.
  void configure(const SmallCrowd& crowd);
  const SmallCrowd& crowd() const { return crowd_; }

  std::filesystem::path config() const { return folder_ / "config.yaml"; }
  std::filesystem::path out() const { return folder_ / "out"; }
  std::filesystem::path cache() const { return folder_ / "cache"; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  std::filesystem::path head(const std::string& name) const {
    return folder_ / "heads" / (name + ".obj");
  }
  const std::vector<std::string>& names() const { return names_; }
  const TemporaryFolder& folder() const { return folder_; }

  /// Heads, filter and masks as the plain computation sees them.
  reference::Heads reference_heads() const;

 private:
  TemporaryFolder folder_;
  SmallCrowd crowd_;
  std::vector<std::string> names_;
  std::vector<reference::Mask> masks_;
};

/// Makes the crowd of the folder's config, with what is `set` in place of its own values.
void run(const SmallCrowdFolder& folder, const std::vector<std::string>& set = {},
         Replace replace = Replace::kRefuse);
void run(const SmallCrowdFolder& folder, const ConfigOverrides& overrides,
         Replace replace = Replace::kRefuse);

/// Makes it in `out`, beside the config.
void run_to(const SmallCrowdFolder& folder, const std::string& out, ConfigOverrides overrides = {},
            Replace replace = Replace::kRefuse);

/// Expects every line of a crowd's plan to have a mesh, and each mesh to be what the plain
/// computation makes of the line, within 2·10⁻⁵ cm.
void expect_meshes_match_plan(const SmallCrowdFolder& folder, const std::filesystem::path& out);

/// Expects the weights of each line of the plan that has a position to be those of Eqs. 3 and 4.
void expect_weights_match_positions(const SmallCrowdFolder& folder,
                                    const std::filesystem::path& out);

/// Expects two OBJ files to be equal byte for byte but for the x y z of `v` and `vn` lines.
void expect_same_but_positions(const std::filesystem::path& target,
                               const std::filesystem::path& result);

}  // namespace crowdface::testing
