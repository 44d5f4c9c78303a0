// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_file.h"

#include <algorithm>
#include <istream>
#include <map>
#include <optional>
#include <span>
#include <streambuf>
#include <utility>

#include <tiny_obj_loader.h>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/io/foreign_file.h"
#include "crowdface/io/obj_mend.h"

namespace crowdface {
namespace {

/// A stream buffer that reads a text in memory without copying it. After a signal such as Ctrl-C,
/// the buffer pretends that the text ends, because tinyobjloader does not check for signals.
class ViewBuffer : public std::streambuf {
 public:
  explicit ViewBuffer(std::string_view text) : rest_(text) {}

 protected:
  int_type underflow() override {
    constexpr std::size_t kAtOnce = 1U << 20U;
    if (rest_.empty() || is_interrupted()) return traits_type::eof();
    const std::string_view piece = rest_.substr(0, kAtOnce);
    rest_.remove_prefix(piece.size());
    char* begin = const_cast<char*>(piece.data());  // the stream only reads the get area
    setg(begin, begin, begin + piece.size());
    return traits_type::to_int_type(*begin);
  }

 private:
  std::string_view rest_;
};

void clear_if_all_none(std::vector<std::uint32_t>& indices) {
  if (std::ranges::count(indices, kNoIndex) == std::ssize(indices)) indices.clear();
}

/// Collects the polygons that tinyobjloader reports to its callbacks. The other function of
/// tinyobjloader, LoadObj, stores the number of corners of a polygon in one byte. Relative indices
/// refer to the rows before their polygon; therefore the class counts these rows.
class PolygonCollector {
 public:
  explicit PolygonCollector(ObjFile& result) : result_(result) {}

  Index vertex_count() const { return vertex_count_; }

  /// \throws InvalidInput if tinyobjloader cannot load the text.
  void load(std::string_view text) {
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* self, auto...) { ++collector(self).vertex_count_; };
    callbacks.texcoord_cb = [](void* self, auto...) { ++collector(self).uv_count_; };
    callbacks.normal_cb = [](void* self, auto...) { ++collector(self).normal_count_; };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
      collector(self).take_polygon({corners, static_cast<std::size_t>(count)});
    };
    ViewBuffer buffer(text);
    std::istream stream(&buffer);
    std::string warning, error;
    const bool is_loaded =
        tinyobj::LoadObjWithCallback(stream, callbacks, this, nullptr, &warning, &error);
    throw_if_interrupted();
    if (!is_loaded) refuse_file(result_.path, concat("cannot be loaded: ", error));
    clear_if_all_none(result_.topology.corner_uvs);
    clear_if_all_none(result_.corner_normals);
  }

 private:
  static PolygonCollector& collector(void* self) { return *static_cast<PolygonCollector*>(self); }

  /// \param number  as in the text: from 1, or negative and relative to the rows so far; 0: none
  static std::uint32_t index_of(int number, Index rows_so_far) {
    if (number == 0) return kNoIndex;
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : rows_so_far + number);
  }

  void take_polygon(std::span<const tinyobj::index_t> corners) {
    Topology& topology = result_.topology;
    for (const tinyobj::index_t& corner : corners) {
      topology.corner_vertices.push_back(index_of(corner.vertex_index, vertex_count_));
      topology.corner_uvs.push_back(index_of(corner.texcoord_index, uv_count_));
      result_.corner_normals.push_back(index_of(corner.normal_index, normal_count_));
    }
    topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
  }

  ObjFile& result_;
  Index vertex_count_ = 0, uv_count_ = 0, normal_count_ = 0;
};

/// Checks that tinyobjloader and `scan_obj` read the same content; a difference means that one of
/// the two readers has a bug.
/// \param loaded  number of vertices that tinyobjloader read
void compare(const ObjScan& scan, Index loaded, const ObjFile& result) {
  const Topology& topology = result.topology;
  const bool in_range =
      std::ranges::all_of(topology.corner_vertices,
                          [&](std::uint32_t vertex) { return vertex < scan.positions.rows(); }) &&
      std::ranges::all_of(topology.corner_uvs,
                          [&](std::uint32_t uv) { return uv == kNoIndex || uv < scan.uvs.rows(); });
  if (loaded != scan.positions.rows() || topology.face_count() != scan.face_count ||
      topology.corner_count() != scan.corner_count || !in_range) {
    refuse_file(result.path,
                concat("expected ", scan.positions.rows(), " vertices and ", scan.face_count,
                       " faces, as the lines of the file say, but reading gave ", loaded, " and ",
                       topology.face_count(), ": export it again, and please report this"));
  }
}

/// Replaces the values that tinyobjloader read with the more accurate values that `scan_obj` read.
void take_scanned_values(ObjScan scan, ObjFile& result) {
  // scan_obj rounds the numbers of the text correctly; tinyobjloader does not.
  result.positions = std::move(scan.positions);
  result.material_libraries = std::move(scan.material_libraries);
  result.materials = std::move(scan.materials);
  result.groups = std::move(scan.groups);
  result.notes.insert(result.notes.end(), scan.notes.begin(), scan.notes.end());
}

/// Checks the text with `scan_obj`. If the text fails the check, repairs the text with `mend_obj`
/// and checks the repaired text.
ObjScan scan_or_mend(ObjFile& obj, const ObjSummary& summary) {
  const std::string name = obj.path.string();
  try {
    return scan_obj(obj.file.bytes(), name, summary, ObjLineSelection::kAll);
  } catch (const InvalidInput&) {
    refuse_non_mesh_file(obj.file.bytes(), obj.path);
    auto mended = mend_obj(obj.file.bytes());
    if (!mended) throw;
    obj.file = MappedFile::from_text(std::move(mended->text));
    obj.notes = std::move(mended->notes);
    obj.is_mended = true;
  }
  return scan_obj(obj.file.bytes(), name, summarise_obj(obj.file.bytes()), ObjLineSelection::kAll);
}

}  // namespace

ObjFile read_obj(const std::filesystem::path& path) {
  MappedFile file(path);
  const ObjSummary summary = summarise_obj(file.bytes());
  return read_obj(path, std::move(file), summary);
}

ObjFile read_obj(const std::filesystem::path& path, MappedFile file, const ObjSummary& summary) {
  ObjFile result;
  result.path = path;
  result.file = std::move(file);
  ObjScan scan = scan_or_mend(result, summary);
  PolygonCollector polygons(result);
  polygons.load(result.file.bytes());
  result.topology.vertex_count = scan.positions.rows();
  compare(scan, polygons.vertex_count(), result);
  result.uvs = std::move(scan.uvs);
  take_scanned_values(std::move(scan), result);
  return result;
}

ObjFile read_obj_of_known_mesh(const std::filesystem::path& path, MappedFile file,
                               const ObjSummary& summary) {
  ObjFile result;
  result.path = path;
  result.file = std::move(file);
  std::optional<ObjScan> scan;
  try {
    scan = scan_obj(result.file.bytes(), path.string(), summary, ObjLineSelection::kAllButMesh);
  } catch (const InvalidInput&) {  // read_obj may repair the text
    return read_obj(path, std::move(result.file), summary);
  }
  take_scanned_values(*std::move(scan), result);
  return result;
}

PolygonMaterials polygon_materials(const std::vector<MaterialRange>& ranges, Index face_count) {
  PolygonMaterials result;
  std::map<std::string_view, std::uint32_t> rows;
  const auto use = [&](std::string_view name, Index begin, Index end) {
    if (begin == end) return;
    const auto [row, is_new] = rows.emplace(name, static_cast<std::uint32_t>(result.names.size()));
    if (is_new) result.names.emplace_back(name);
    result.material_of_polygon.insert(result.material_of_polygon.end(),
                                      static_cast<std::size_t>(end - begin), row->second);
  };
  use("", 0, ranges.empty() ? face_count : ranges.front().first_face);
  for (std::size_t m = 0; m < ranges.size(); ++m) {
    use(ranges[m].name, ranges[m].first_face,
        m + 1 < ranges.size() ? ranges[m + 1].first_face : face_count);
  }
  return result;
}

}  // namespace crowdface
