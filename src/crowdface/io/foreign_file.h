// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crowdface {

/// Rejects files that are clearly not meshes: web pages saved by a browser, archives, images,
/// scenes of modelling programs.
/// \throws InvalidInput with the kind of file found and how to obtain the mesh.
void refuse_non_mesh_file(std::string_view bytes, const std::filesystem::path& path);

/// For a file that a browser, a server or Git stored instead of the wanted file, returns a text
/// that says what the file is and how to obtain the wanted file. Returns an empty text for other
/// files.
std::string_view describe_failed_download(std::string_view bytes);

/// For a NumPy archive of several arrays (.npz), returns a text that says what the file is and how
/// to save each array in a file of its own. Returns an empty text for other files.
std::string describe_numpy_archive(std::string_view bytes, const std::filesystem::path& path);

/// Returns advice for an error message: how to correct a mesh file that contains `word` where a
/// finite number is expected. For example, "1,5" contains a decimal comma. Empty if the cause is
/// unknown.
std::string_view advice_on_bad_number(std::string_view word);

}  // namespace crowdface
