// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace crowdface {

/// Rejects files that are clearly not meshes: web pages saved by a browser, archives, images,
/// scenes of modelling programs.
/// \throws InvalidInput with the kind of file found and how to obtain the mesh.
void refuse_foreign_file(std::string_view bytes, const std::filesystem::path& path);

/// Advice to the user about a word that a text mesh has in place of a finite number, such as "1,5"
/// (decimal comma) or "nan". Empty if there is no advice for the word.
std::string_view advice_on_number(std::string_view word);

}  // namespace crowdface
