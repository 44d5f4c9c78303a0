// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/io/material_files.h"

namespace crowdface {

/// The `mtllib` line that names material files; nothing if there are none.
/// \param from  where their places are relative to.
std::string library_line(const std::vector<MaterialFile>& files, const std::filesystem::path& from);

}  // namespace crowdface
