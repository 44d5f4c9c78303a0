// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/run/wrap_inputs.h"

#include "cli/common_options.h"

namespace crowdface::cli {

/// The options and arguments of the command `wrap`.
struct WrapCommand : CommonOptions, WrapOptions {
  /// The argument TEMPLATE.obj; --batch needs --template in its place.
  std::string template_argument;
  std::string shard_text;  ///< value of `--shard`, the part of the batch, such as 2/7
  std::string port = "0";  ///< TCP port of the page of --pick; 0: any free port
  bool pick = false, no_browser = false;  ///< whether these options are given
};

/// Executes `wrap --pick`: serves the page on which the user picks landmarks on the template and on
/// the scan.
/// \throws Error
void pick(const WrapCommand& options);

}  // namespace crowdface::cli
