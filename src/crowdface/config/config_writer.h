// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/config/config.h"

namespace crowdface {

/// The config as YAML with every default spelled out, keys in a fixed order: the same config gives
/// the same bytes. Read from a file in `directory`, it gives the same config again.
/// \param directory  where the text will be written; paths in it are relative to this folder.
std::string effective_config(const Config& config, const std::filesystem::path& directory);

}  // namespace crowdface
