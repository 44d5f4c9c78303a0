// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "crowdface/core/error.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/io/foreign_file.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/obj_colours.h"

namespace crowdface {
namespace {

enum class Coding { kText, kLittleEndian, kBigEndian };

template <class T>
double number_in(const std::array<char, 8>& raw) {
  T number;
  std::memcpy(&number, raw.data(), sizeof number);
  return static_cast<double>(number);
}

/// A number type of PLY, and its size in bytes in binary files.
struct Type {
  std::string_view name, other;
  std::size_t bytes;
  double full;  ///< for colours stored in this type: the largest value (full brightness)
  double (*read)(const std::array<char, 8>&);
};
constexpr std::array<Type, 10> kTypes = {{{"char", "int8", 1, 127, number_in<std::int8_t>},
                                          {"uchar", "uint8", 1, 255, number_in<std::uint8_t>},
                                          {"short", "int16", 2, 32767, number_in<std::int16_t>},
                                          {"ushort", "uint16", 2, 65535, number_in<std::uint16_t>},
                                          {"int", "int32", 4, 255, number_in<std::int32_t>},
                                          {"uint", "uint32", 4, 255, number_in<std::uint32_t>},
                                          {"float", "float32", 4, 1, number_in<float>},
                                          {"double", "float64", 8, 1, number_in<double>},
                                          {"long", "int64", 8, 255, number_in<std::int64_t>},
                                          {"ulong", "uint64", 8, 255, number_in<std::uint64_t>}}};

struct Property {
  std::string name;
  Type type;
  /// For a list, the number type of its length; nothing: the property is not a list.
  std::optional<Type> count = {};
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

constexpr const char* kBlanks = " \t\r\n";
constexpr const char* kEndsTooSoon = "it ends too soon: copy or export it again";
constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();

/// Reads a whole PLY file.
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  FileMesh read() {
    read_header();
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else {
        read_faces(element);
      }
    }
    mesh_.topology.vertex_count = mesh_.positions.rows();
    for (const std::uint32_t v : mesh_.topology.corner_vertices) {
      if (v >= mesh_.topology.vertex_count) {
        fail(concat("a face refers to vertex ", v, " of ", mesh_.topology.vertex_count));
      }
    }
    finish_uvs();
    finish_textures();
    if (flat_faces_ > 0) {
      mesh_.notes.push_back(
          concat(flat_faces_, " of its faces have fewer than 3 corners and are left out"));
    }
    if (long_lines_ > 0) {
      mesh_.notes.push_back(concat(long_lines_,
                                   " of its lines have more numbers than its header says; the "
                                   "numbers at their ends are not read"));
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& found) const {
    throw InvalidInput(concat(name_, ": expected a PLY file, found that ", found));
  }

  /// Reads a header line. Lines end in LF, CR LF or CR; all lines of a file have the same end as
  /// its first line.
  std::string_view line() {
    const char last = ends_in_cr_ ? '\r' : '\n';
    const std::size_t end = bytes_.find(last, at_);
    if (end == std::string_view::npos) fail("its header has no end");
    const std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }

  Type type_of(const std::string& word) const {
    for (const Type& known : kTypes) {
      if (word == known.name || word == known.other) return known;
    }
    fail(concat("a property is of type ", quoted(word)));
  }

  Coding coding_of(const std::string& word) const {
    if (word == "ascii") return Coding::kText;
    if (word == "binary_little_endian") return Coding::kLittleEndian;
    if (word == "binary_big_endian") return Coding::kBigEndian;
    fail(concat("its format is ", quoted(word)));
  }

  void read_header() {
    if (bytes_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    const std::size_t end = bytes_.find_first_of("\r\n", at_);
    ends_in_cr_ =
        end != bytes_.npos && bytes_[end] == '\r' && !bytes_.substr(end + 1).starts_with('\n');
    if (words_of(line()) != std::vector<std::string>{"ply"}) fail("it does not begin with ply");
    for (;;) {
      const std::string_view text = line();
      const std::vector<std::string> words = words_of(text);
      add_texture_file(text);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() >= 2) {
        coding_ = coding_of(words[1]);
      } else if (words[0] == "element" && words.size() == 3 && parse_unsigned(words[2])) {
        elements_.push_back({words[1], *parse_unsigned(words[2]), {}});
      } else if (words[0] == "property" && words.size() == 3 && !elements_.empty()) {
        elements_.back().properties.push_back({lower_case(words[2]), type_of(words[1])});
      } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" &&
                 !elements_.empty()) {
        elements_.back().properties.push_back(
            {lower_case(words[4]), type_of(words[3]), type_of(words[2])});
      } else if (words[0] == "format" || words[0] == "element" || words[0] == "property") {
        fail(concat("its header says ", quoted(join(words, " "))));
      } else if (mesh_.notes.empty()) {  // one note is enough, however damaged the header is
        mesh_.notes.push_back(concat("the line ", quoted(join(words, " ")),
                                     " of its header is not understood and is not used"));
      }
    }
    for (const Element& element : elements_) {
      if (element.count > bytes_.size()) fail(concat("it claims ", element.count, " elements"));
      if (std::ranges::count(element.properties, "f_dc_0", &Property::name) > 0) {
        fail("it is a Gaussian splat, which has no surface: export a mesh");
      }
    }
    has_line_per_element_ = coding_ == Coding::kText && has_as_many_lines_as_elements();
  }

  bool has_as_many_lines_as_elements() const {
    std::uint64_t lines = 0, elements = 0;
    for (const Element& element : elements_) {
      if (!element.properties.empty()) elements += element.count;
    }
    for (std::size_t at = at_; (at = bytes_.find_first_not_of(kBlanks, at)) != bytes_.npos;) {
      ++lines;
      at = std::min(bytes_.find_first_of("\r\n", at), bytes_.size());
    }
    return lines == elements;
  }

  void begin_element() {
    if (!has_line_per_element_) return;
    at_ = std::min(bytes_.find_first_not_of(kBlanks, at_), bytes_.size());
    line_end_ = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
  }

  /// Passes over the rest of the element's line: some programs write numbers that the header does
  /// not name.
  void end_element() {
    if (!has_line_per_element_) return;
    if (bytes_.substr(at_, line_end_ - at_).find_first_not_of(" \t") != bytes_.npos) ++long_lines_;
    at_ = line_end_;
  }

  /// Adds the texture that a comment in the header names, as Metashape and MeshLab write it.
  void add_texture_file(std::string_view header_line) {
    constexpr std::string_view kTextureFile = "comment TextureFile ";
    if (!header_line.starts_with(kTextureFile)) return;
    header_line.remove_prefix(kTextureFile.size());
    header_line = header_line.substr(0, header_line.find_last_not_of(" \t\r") + 1);
    if (!header_line.empty()) texture_files_.emplace_back(header_line);
  }

  double value(const Type& type) {
    if (coding_ == Coding::kText) return word();
    if (bytes_.size() - at_ < type.bytes) fail(kEndsTooSoon);
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), bytes_.data() + at_, type.bytes);
    at_ += type.bytes;
    if (coding_ == Coding::kBigEndian) std::reverse(raw.data(), raw.data() + type.bytes);
    return type.read(raw);
  }

  /// Reads a word as a number. Normals and quality values may be non-numeric words such as "nan".
  double word() {
    const std::size_t begin = bytes_.find_first_not_of(kBlanks, at_);
    if (begin == std::string_view::npos) fail(kEndsTooSoon);
    if (has_line_per_element_ && begin >= line_end_) {
      const auto line = 1 + std::ranges::count(bytes_.substr(0, at_), ends_in_cr_ ? '\r' : '\n');
      fail(concat("line ", line, " has fewer numbers than its header says: export it again"));
    }
    at_ = std::min(bytes_.find_first_of(kBlanks, begin), bytes_.size());
    const std::string_view word = bytes_.substr(begin, at_ - begin);
    if (const auto number = parse_double(word)) return *number;
    const std::string lower = lower_case(word);
    for (const std::string_view none : {"nan", "inf", "1.#"}) {
      if (lower.find(none) != lower.npos) return std::numeric_limits<double>::quiet_NaN();
    }
    if (at_ == bytes_.size()) fail(kEndsTooSoon);
    fail(concat(quoted(word), " is not a number", advice_on_bad_number(word)));
  }

  static std::size_t column_of(const Element& element, std::initializer_list<const char*> names) {
    for (const char* name : names) {
      const auto found = std::ranges::find(element.properties, name, &Property::name);
      if (found != element.properties.end() && !found->count) {
        return static_cast<std::size_t>(found - element.properties.begin());
      }
    }
    return kNoColumn;
  }

  void read_vertices(const Element& element) {
    if (mesh_.positions.rows() > 0) fail("it has two vertex elements");
    if (element.count > input_limits().vertices) {
      fail(concat("it has ", element.count, " vertices, more than ", input_limits().vertices,
                  " (--limit)"));
    }
    const std::array<std::size_t, 3> place = {column_of(element, {"x"}), column_of(element, {"y"}),
                                              column_of(element, {"z"})};
    for (std::size_t c = 0; c < 3; ++c) {
      if (place[c] == kNoColumn) fail(concat("its vertices have no ", std::string(1, "xyz"[c])));
    }
    const std::array<std::size_t, 3> colour = {column_of(element, {"red", "diffuse_red", "r"}),
                                               column_of(element, {"green", "diffuse_green", "g"}),
                                               column_of(element, {"blue", "diffuse_blue", "b"})};
    const std::array<std::size_t, 2> uv = {column_of(element, {"s", "u", "texture_u"}),
                                           column_of(element, {"t", "v", "texture_v"})};
    const bool has_colours = std::ranges::find(colour, kNoColumn) == colour.end();
    has_vertex_uvs_ = uv[0] != kNoColumn && uv[1] != kNoColumn;
    const auto count = static_cast<Index>(element.count);
    mesh_.positions.resize(count, 3);
    mesh_.colours.resize(has_colours ? count : 0, 3);
    mesh_.uvs.resize(has_vertex_uvs_ ? count : 0, 2);
    std::vector<double> values(element.properties.size());
    for (Index v = 0; v < count; ++v) {
      begin_element();
      for (std::size_t p = 0; p < values.size(); ++p) {
        const Property& property = element.properties[p];
        if (property.count) {
          skip_list(property);
        } else {
          values[p] = value(property.type);
        }
      }
      end_element();
      for (std::size_t c = 0; c < 3; ++c) {
        const auto column = static_cast<Index>(c);
        mesh_.positions(v, column) = values[place[c]];
        if (has_colours) {
          const double full = element.properties[colour[c]].type.full;
          const double share = values[colour[c]] / full;
          mesh_.colours(v, column) = std::isnan(share) ? 0 : share;
        }
        if (has_vertex_uvs_ && c < 2) mesh_.uvs(v, column) = values[uv[c]];
      }
    }
    if (mesh_.colours.rows() == 0) return;
    constexpr double kMaxByte = 255;
    if (mesh_.colours.maxCoeff() > kLargestFraction) mesh_.colours /= kMaxByte;
    mesh_.colours = mesh_.colours.cwiseMax(0).cwiseMin(1);
  }

  std::uint64_t list_count(const Property& property) {
    const double count = value(*property.count);
    if (!(count >= 0 && count <= static_cast<double>(bytes_.size()))) {
      fail(concat("a list has ", count, " entries"));
    }
    return static_cast<std::uint64_t>(count);
  }

  void skip_list(const Property& property) {
    for (std::uint64_t i = list_count(property); i > 0; --i) value(property.type);
  }

  void read_faces(const Element& element) {
    if (element.properties.empty()) return;  // no data, whatever the count
    const bool faces = element.name == "face", strips = element.name == "tristrips";
    for (std::uint64_t f = 0; f < element.count; ++f) {
      begin_element();
      std::vector<std::int64_t> corners;
      std::vector<double> uvs;
      double texture = 0;
      for (const Property& property : element.properties) {
        const bool is_corners =
            (faces || strips) && property.count &&
            (property.name == "vertex_indices" || property.name == "vertex_index");
        const bool is_uvs = faces && property.count && property.name == "texcoord";
        if (!property.count) {
          const double number = value(property.type);
          if (property.name == "texnumber") texture = number;
        } else if (!is_corners && !is_uvs) {
          skip_list(property);
        }
        if (!is_corners && !is_uvs) continue;
        for (std::uint64_t i = list_count(property); i > 0; --i) {
          const double number = value(property.type);
          if (is_uvs) {
            uvs.push_back(number);
          } else if (number >= 0 && number < 4e9) {
            corners.push_back(static_cast<std::int64_t>(number));
          } else if (strips && number < 0) {
            corners.push_back(-1);
          } else {
            fail(concat("a face refers to vertex ", number));
          }
        }
      }
      end_element();
      if (strips) {
        add_strips(corners);
      } else if (faces) {
        use_texture(texture);
        add_face(corners, uvs);
      }
    }
  }

  /// Starts a range of polygons: the polygons that are added later get the material of a texture.
  /// \param number  index into `texture_files_`; ignored if it is out of range.
  void use_texture(double number) {
    if (!(number >= 0 && number < static_cast<double>(texture_files_.size()))) return;
    const std::string material = material_of_texture(static_cast<std::size_t>(number));
    if (!mesh_.materials.empty() && mesh_.materials.back().name == material) return;
    mesh_.materials.push_back({material, mesh_.topology.face_count()});
  }

  static std::string material_of_texture(std::size_t number) {
    return concat("texture_", number + 1);
  }

  void add_face(const std::vector<std::int64_t>& corners, const std::vector<double>& uvs) {
    constexpr std::size_t kMin = 3;
    if (corners.size() < kMin) {
      ++flat_faces_;
      return;
    }
    Topology& topology = mesh_.topology;
    const bool has_uvs = uvs.size() == 2 * corners.size() &&
                         std::ranges::all_of(uvs, [](double uv) { return std::isfinite(uv); });
    for (std::size_t c = 0; c < corners.size(); ++c) {
      topology.corner_vertices.push_back(static_cast<std::uint32_t>(corners[c]));
      if (has_uvs) {
        topology.corner_uvs.resize(topology.corner_vertices.size() - 1, kNoIndex);
        topology.corner_uvs.push_back(static_cast<std::uint32_t>(corner_uvs_.size() / 2));
        corner_uvs_.push_back(uvs[2 * c]);
        corner_uvs_.push_back(uvs[2 * c + 1]);
      }
    }
    topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
  }

  void add_strips(const std::vector<std::int64_t>& strip) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < strip.size(); ++i) {
      if (strip[i] < 0) first = i + 1;
      if (i < first + 2) continue;
      const bool odd = (i - first) % 2 != 0;
      const std::int64_t a = strip[i - 2], b = strip[odd ? i : i - 1], c = strip[odd ? i - 1 : i];
      if (a != b && b != c && c != a) add_face({a, b, c}, {});
    }
  }

  /// If no corner has a texture coordinate, gives each corner the texture coordinate of its vertex.
  void finish_uvs() {
    Topology& topology = mesh_.topology;
    if (!topology.corner_uvs.empty()) {
      topology.corner_uvs.resize(topology.corner_vertices.size(), kNoIndex);
      mesh_.uvs.resize(static_cast<Index>(corner_uvs_.size() / 2), 2);
      std::copy(corner_uvs_.begin(), corner_uvs_.end(), mesh_.uvs.data());
    } else if (has_vertex_uvs_ && mesh_.uvs.allFinite()) {
      // If a format has texture coordinates only at vertices, the exporter has split the vertices
      // at seams.
      topology.corner_uvs = topology.corner_vertices;
      mesh_.mesh_of_vertex.assign(static_cast<std::size_t>(topology.vertex_count), 0);
    } else if (has_vertex_uvs_) {
      mesh_.uvs.resize(0, 2);
      mesh_.notes.emplace_back("its texture coordinates are not numbers and are ignored");
    }
  }

  void finish_textures() {
    for (std::size_t t = 0; t < texture_files_.size(); ++t) {
      mesh_.textures.push_back({material_of_texture(t), TextureKind::kColour, {}});
    }
    read_texture_files(std::move(texture_files_), name_, mesh_);
  }

  std::string_view bytes_;
  const std::string& name_;
  std::vector<std::string> texture_files_;
  std::size_t at_ = 0;
  bool ends_in_cr_ = false, has_vertex_uvs_ = false;
  /// Whether each element of a text file has a line of its own. Common programs write such files;
  /// the format also allows several elements in one line, and line breaks within an element.
  bool has_line_per_element_ = false;
  std::size_t line_end_ = 0;  ///< end of the line of the element that is being read
  Coding coding_ = Coding::kText;
  std::vector<Element> elements_;
  std::vector<double> corner_uvs_;
  std::size_t flat_faces_ = 0, long_lines_ = 0;
  FileMesh mesh_;
};

}  // namespace

FileMesh parse_ply(std::string_view bytes, const std::string& name) {
  return PlyReader(bytes, name).read();
}

}  // namespace crowdface
