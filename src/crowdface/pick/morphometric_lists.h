// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// A landmark as a file lists it.
struct ListedLandmark {
  /// name of the landmark; if the file has no name: its position in the list, from 1
  std::string name;
  std::vector<double> numbers;  ///< coordinates x, y and z of the landmark
  std::size_t line;             ///< number of the landmark's line in the file, from 1
};

/// Whether a field of a list stands for a missing value, such as NA or an empty field.
bool is_missing_value(std::string_view field);

/// Throws an exception that names the file, a line (from 1) and what is wrong there.
using FailAtLine = std::function<void(std::size_t line, const std::string& what)>;

/// The extensions of the formats that parse_morphometric_list reads.
const std::vector<std::string>& morphometric_extensions();

/// Reads a text format of programs for morphometrics or face alignment: points of Landmark Editor
/// and of the 300-W data set (.pts), TPS (.tps), NTSYS (.nts, and .dta of Landmark Editor), and
/// landmarks of Amira and Avizo (.landmarkAscii). Omits landmarks that the file marks as missing.
/// \param extension  in lower case.
/// \param fail       is called for landmarks in two dimensions, for several specimens, and for text
///                   that does not have the format.
/// \return nothing if the extension belongs to no such format.
std::optional<std::vector<ListedLandmark>> parse_morphometric_list(std::string_view text,
                                                                   std::string_view extension,
                                                                   const FailAtLine& fail);

}  // namespace crowdface
