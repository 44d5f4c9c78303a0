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

/// Encodes positions as a NumPy file (version 1.0), which `numpy.load` reads: little-endian single
/// precision, #V by 3, row-major.
/// \param what  names the mesh in messages.
/// \throws InvalidInput if positions are not finite.
EncodedFile encode_npy(const Positions& positions, const std::string& what);
/// Encodes the displacements of all blend shapes as one NumPy array of records: `shape` (uint32,
/// index of the shape), `vertex` (uint32) and `delta` (float32, 3), sorted by shape and vertex.
/// Vertices that do not move have no record.
/// \throws InvalidInput if displacements are not finite.
EncodedFile encode_npy(std::span<const Displacements> shapes, const std::string& what);
/// Memory needed for one call of `encode_npy`, in bytes.
std::size_t npy_encode_bytes(Index vertices);

/// Reads positions that `encode_npy` wrote.
/// \throws InvalidInput if the file has any other content.
Positions read_npy(const std::filesystem::path& path);

/// Names of the files that `write_topology_arrays` writes.
inline constexpr std::array kTopologyArrays = {"corners.npy", "offsets.npy", "uvs.npy",
                                               "corner_uvs.npy", "shape_names.npy"};

/// Writes the topology as arrays in a folder, because files of positions do not contain the
/// topology: `corners.npy` (int32, #C, the vertices of all polygons, one polygon after the other),
/// `offsets.npy` (int32, #F + 1, index of each polygon's first corner) and, if there are texture
/// coordinates, `uvs.npy` (float32, #T by 2) and `corner_uvs.npy` (int32, #C, row of `uvs` for each
/// corner; −1: none). If there are shapes, also `shape_names.npy`.
/// \throws InvalidInput if an index needs more than 31 bits; CannotCreate, IoError.
/// \return the files, in this order.
std::vector<std::filesystem::path> write_topology_arrays(const Topology& topology,
                                                         const TextureCoordinates& uvs,
                                                         std::span<const std::string> shapes,
                                                         const std::filesystem::path& folder);

}  // namespace crowdface
