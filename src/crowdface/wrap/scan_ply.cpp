// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/wrap/scan_file.h"

namespace crowdface {
namespace {

enum class Coding { kText, kLittleEndian, kBigEndian };

template <class T>
double number_in(const std::array<char, 8>& raw) {
  T number;
  std::memcpy(&number, raw.data(), sizeof number);
  return static_cast<double>(number);
}

/// What a number is, as long as it takes in a binary file.
struct Type {
  std::string_view name, other;
  std::size_t bytes;
  double (*read)(const std::array<char, 8>&);
};
constexpr std::array<Type, 8> kTypes = {{{"char", "int8", 1, number_in<std::int8_t>},
                                         {"uchar", "uint8", 1, number_in<std::uint8_t>},
                                         {"short", "int16", 2, number_in<std::int16_t>},
                                         {"ushort", "uint16", 2, number_in<std::uint16_t>},
                                         {"int", "int32", 4, number_in<std::int32_t>},
                                         {"uint", "uint32", 4, number_in<std::uint32_t>},
                                         {"float", "float32", 4, number_in<float>},
                                         {"double", "float64", 8, number_in<double>}}};

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count = {};  ///< of a list: of its count
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

/// Reads a PLY file from its first byte to its last.
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Scan read() {
    read_header();
    Scan scan;
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        read_vertices(element, scan);
      } else {
        read_faces(element, scan);
      }
    }
    const auto count = static_cast<std::uint32_t>(scan.positions.rows());
    for (const Triangle& t : scan.triangles) {
      for (const std::uint32_t v : t) {
        if (v >= count) fail(concat("a face names vertex ", v, " of ", count));
      }
    }
    return scan;
  }

 private:
  [[noreturn]] void fail(const std::string& found) const {
    throw InvalidInput(concat(name_, ": expected a PLY file, found that ", found));
  }

  std::string_view line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) fail("its header does not end");
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
    if (words_of(line()) != std::vector<std::string>{"ply"}) fail("it does not begin with ply");
    for (;;) {
      const std::vector<std::string> words = words_of(line());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() == 3) {
        coding_ = coding_of(words[1]);
      } else if (words[0] == "element" && words.size() == 3 && parse_unsigned(words[2])) {
        elements_.push_back({words[1], *parse_unsigned(words[2]), {}});
      } else if (words[0] == "property" && words.size() == 3 && !elements_.empty()) {
        elements_.back().properties.push_back({words[2], type_of(words[1])});
      } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" &&
                 !elements_.empty()) {
        elements_.back().properties.push_back({words[4], type_of(words[3]), type_of(words[2])});
      } else {
        fail(concat("its header says ", quoted(join(words, " "))));
      }
    }
    for (const Element& element : elements_) {
      if (element.count > bytes_.size()) fail(concat("it claims ", element.count, " elements"));
    }
  }

  double value(const Type& type) {
    if (coding_ == Coding::kText) return word();
    if (bytes_.size() - at_ < type.bytes) fail("it ends too soon");
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), bytes_.data() + at_, type.bytes);
    at_ += type.bytes;
    if (coding_ == Coding::kBigEndian) std::reverse(raw.data(), raw.data() + type.bytes);
    return type.read(raw);
  }

  double word() {
    const std::size_t begin = bytes_.find_first_not_of(" \t\r\n", at_);
    if (begin == std::string_view::npos) fail("it ends too soon");
    at_ = std::min(bytes_.find_first_of(" \t\r\n", begin), bytes_.size());
    const auto number = parse_double(bytes_.substr(begin, at_ - begin));
    if (!number) fail(concat("a number reads ", quoted(bytes_.substr(begin, at_ - begin))));
    return *number;
  }

  void read_vertices(const Element& element, Scan& scan) {
    std::array<std::size_t, 3> column{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string wanted(1, "xyz"[c]);
      const auto found = std::ranges::find(element.properties, wanted, &Property::name);
      if (found == element.properties.end()) fail(concat("its vertices have no ", wanted));
      column[c] = static_cast<std::size_t>(found - element.properties.begin());
    }
    scan.positions.resize(static_cast<Index>(element.count), 3);
    std::vector<double> values(element.properties.size());
    for (Index v = 0; v < scan.positions.rows(); ++v) {
      for (std::size_t p = 0; p < values.size(); ++p) {
        const Property& property = element.properties[p];
        if (property.count) {
          skip_list(property);
        } else {
          values[p] = value(property.type);
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        scan.positions(v, static_cast<Index>(c)) = values[column[c]];
      }
    }
  }

  std::uint64_t list_count(const Property& property) {
    const double count = value(*property.count);
    if (!(count >= 0 && count <= 1e6)) fail(concat("a list has ", count, " entries"));
    return static_cast<std::uint64_t>(count);
  }

  void skip_list(const Property& property) {
    for (std::uint64_t i = list_count(property); i > 0; --i) value(property.type);
  }

  void read_faces(const Element& element, Scan& scan) {
    if (element.properties.empty()) return;  // however many there are
    for (std::uint64_t f = 0; f < element.count; ++f) {
      for (const Property& property : element.properties) {
        const bool corners = element.name == "face" && property.count &&
                             (property.name == "vertex_indices" || property.name == "vertex_index");
        if (property.count && !corners) skip_list(property);
        if (!property.count) value(property.type);
        if (!corners) continue;
        std::vector<std::uint32_t> face;
        for (std::uint64_t i = list_count(property); i > 0; --i) {
          const double corner = value(property.type);
          if (!(corner >= 0 && corner < 4e9)) fail(concat("a face names vertex ", corner));
          face.push_back(static_cast<std::uint32_t>(corner));
        }
        for (std::size_t c = 1; c + 1 < face.size(); ++c) {
          scan.triangles.push_back({face[0], face[c], face[c + 1]});
        }
      }
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  Coding coding_ = Coding::kText;
  std::vector<Element> elements_;
};

}  // namespace

Scan parse_ply(std::string_view bytes, const std::string& name) {
  return PlyReader(bytes, name).read();
}

}  // namespace crowdface
