// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/outward_polygons.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crowdface/core/text.h"
#include "crowdface/mesh/winding.h"

namespace crowdface {
namespace {

/// The OBJ text with reversed polygons: the first corner of each polygon stays first, and its other
/// corners are in reverse order.
std::string with_reversed_polygons(std::string_view text) {
  std::string turned;
  turned.reserve(text.size());
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    const bool is_last = end == text.size();
    begin = end + 1;
    const std::string_view ending =
        line.ends_with('\r') ? (is_last ? "\r" : "\r\n") : (is_last ? "" : "\n");
    if (line.ends_with('\r')) line.remove_suffix(1);
    std::vector<std::string> words;
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != line.npos && line[first] == 'f') words = words_of(line);
    if (words.size() > 2 && words[0] == "f") {
      std::reverse(words.begin() + 2, words.end());
      turned += words[0];
      for (std::size_t w = 1; w < words.size(); ++w) turned += concat(' ', words[w]);
    } else {
      turned += line;
    }
    turned += ending;
  }
  return turned;
}

}  // namespace

void reverse_inward_faces(FileMesh& mesh) {
  if (!is_inside_out(mesh.topology, mesh.positions)) return;
  reverse_faces(mesh.topology);
  mesh.notes.emplace_back(kReversedFacesNote);
}

ObjFile with_outward_faces(ObjFile file) {
  if (!is_inside_out(file.topology, file.positions)) return file;
  MappedFile text = MappedFile::from_text(with_reversed_polygons(file.file.bytes()));
  const ObjSummary summary = summarise_obj(text.bytes());
  ObjFile turned = read_obj(file.path, std::move(text), summary);
  turned.notes = std::move(file.notes);
  turned.is_mended = turned.has_reversed_faces = true;
  turned.material_base = std::move(file.material_base);
  return turned;
}

}  // namespace crowdface
