// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Positions as NumPy's own file, which `numpy.load` reads: version 1.0, little-endian single
/// precision, #V by 3, row by row.
/// \param what  names the mesh in messages.
/// \throws InvalidInput if positions are not finite.
EncodedFile encode_npy(const Positions& positions, const std::string& what);
/// Displacements of shapes as one NumPy array of records, `shape` (uint32, which of them), `vertex`
/// (uint32) and `delta` (float32, 3), sorted by the first two; what does not move has no record.
/// \throws InvalidInput if displacements are not finite.
EncodedFile encode_npy(std::span<const Displacements> shapes, const std::string& what);
/// What one encode_npy takes.
std::size_t npy_encode_bytes(Index vertices);

/// Positions that encode_npy made. \throws InvalidInput if the file is anything else.
Positions read_npy(const std::filesystem::path& path);

inline constexpr std::array kTopologyArrays = {"corners.npy", "offsets.npy", "uvs.npy",
                                               "corner_uvs.npy", "shape_names.npy"};

/// Writes what positions alone do not say, as arrays in a folder: `corners.npy` (int32, #C, the
/// vertices of all faces one face after the other), `offsets.npy` (int32, #F + 1, where each face's
/// corners begin) and, if there are texture coordinates, `uvs.npy` (float32, #T by 2) and
/// `corner_uvs.npy` (int32, #C, the row of each corner; −1: none).
/// With shapes also `shape_names.npy`.
/// \throws InvalidInput if an index needs more than 31 bits; CannotCreate, IoError.
/// \return the files, in this order.
std::vector<std::filesystem::path> write_topology_arrays(const Topology& topology,
                                                         const TextureCoordinates& uvs,
                                                         std::span<const std::string> shapes,
                                                         const std::filesystem::path& folder);

}  // namespace crowdface
