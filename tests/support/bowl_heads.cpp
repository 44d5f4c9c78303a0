// SPDX-License-Identifier: Apache-2.0
#include "support/bowl_heads.h"

#include <charconv>
#include <cmath>
#include <fstream>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"

namespace crowdface::testing {
namespace {

double noise(std::uint64_t seed, std::uint64_t index, std::string_view purpose) {
  return random_between({seed, index, purpose, 0}, -1, 1);
}

std::string single(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(value)).ptr;
  return {buffer, end};
}

reference::Point place(const Bowl& bowl, std::uint64_t person, int row, int column) {
  const double s = 2.0 * column / bowl.columns - 1, t = 2.0 * row / bowl.rows - 1;
  double z = 6 - 3 * (s * s + t * t);
  for (std::uint64_t b = 0; b < 6; ++b) {
    const double ds = s - noise(b, 1, "bump"), dt = t - noise(b, 2, "bump");
    z += 0.9 * noise(person, b, "height") * std::exp(-5 * (ds * ds + dt * dt));
  }
  const int vertex = row * (bowl.columns + 1) + column;
  const auto index = static_cast<std::uint64_t>(vertex);
  z += 0.06 * noise(person, index, "pores");
  return {(7 + 0.3 * noise(person, 0, "width")) * s + 0.05 * noise(person, index, "x"),
          (8 + 0.3 * noise(person, 0, "length")) * t + 0.05 * noise(person, index, "y"), z};
}

/// Gathers the lines of a file.
class Text {
 public:
  explicit Text(const Bowl& bowl) : end_(bowl.crlf ? "\r\n" : "\n") {}
  template <class... Parts>
  void line(const Parts&... parts) {
    text_ += concat(parts...) + end_;
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string end_, text_;
};

bool in_hole(const Bowl& bowl, int row, int column) {
  return std::abs(row - bowl.rows / 3) <= 0 && std::abs(2 * column - bowl.columns + 1) <= 2;
}

void write_vertices(const Bowl& bowl, std::uint64_t person, Text& text) {
  std::size_t number = 0;
  const auto vertex = [&](const reference::Point& p) {
    const std::string x = single(p[0] * bowl.per_cm), y = single(p[1] * bowl.per_cm),
                      z = single(p[2] * bowl.per_cm);
    ++number;
    if (bowl.odd_text && number % 11 == 4) {
      text.line("  v \t", x, ' ', y, ' ', z, " 1.0");
    } else if (bowl.odd_text && number % 11 == 7) {
      text.line("v  ", x, ' ', y, ' ', z, " 0.25 0.5 0.750 ");
    } else {
      text.line("v ", x, ' ', y, ' ', z);
    }
  };
  for (int row = 0; row <= bowl.rows; ++row) {
    if (bowl.odd_text && row == 2) text.line("# half-way # down\t");
    for (int column = 0; column <= bowl.columns; ++column) vertex(place(bowl, person, row, column));
  }
  for (int c = 0; c < 8; ++c) {
    const double size = 0.8 + 0.1 * noise(person, 0, "eye");
    vertex({(c & 1) != 0 ? size : -size, (c & 2) != 0 ? size : -size, (c & 4) != 0 ? size : -size});
  }
  vertex({0.5, -0.25, 3 + 0.2 * noise(person, 0, "stray")});
}

void write_uvs(const Bowl& bowl, Text& text) {
  for (const double shrink : {1.0, 0.9}) {  // the second copy is for the faces right of the seam
    for (int row = 0; row <= bowl.rows; ++row) {
      for (int column = 0; column <= bowl.columns; ++column) {
        const double u = shrink * (bowl.tiles * column / static_cast<double>(bowl.columns));
        text.line("vt ", single(u), ' ', single(row / static_cast<double>(bowl.rows)));
      }
    }
  }
}

/// Corners "v/vt/vn" of one face; `uv_shift` picks the copy of the texture coordinates.
std::string face_line(const Bowl& bowl, const std::vector<int>& vertices, int uv_shift) {
  std::string line = "f";
  const int stride = bowl.columns + 1, grid = stride * (bowl.rows + 1);
  for (const int v : vertices) {
    line += concat(' ', v + 1);
    const int e = v - grid;  // a corner of the eye takes one of the first four of two rows
    const int uv = e < 0 ? v : e / 4 * stride + e % 4;
    if (bowl.uvs) line += concat('/', uv + uv_shift + 1);
    if (bowl.normals) line += concat(bowl.uvs ? "/" : "//", v + 1);
  }
  return line;
}

void write_faces(const Bowl& bowl, Text& text) {
  const int stride = bowl.columns + 1, grid = stride * (bowl.rows + 1);
  for (int row = 0; row < bowl.rows; ++row) {
    for (int column = 0; column < bowl.columns; ++column) {
      if (in_hole(bowl, row, column)) continue;
      const int a = row * stride + column, b = a + 1, c = b + stride, d = a + stride;
      const int uv = column >= bowl.columns / 2 ? grid : 0;
      if (row == 1 && column == 1) {
        text.line(face_line(bowl, {a, b, b + 1, c + 1, c, d}, uv));
        ++column;
      } else if ((row + column) % 7 == 3) {
        text.line(face_line(bowl, {a, b, c}, uv));
        text.line(face_line(bowl, {a, c, d}, uv));
      } else {
        text.line(face_line(bowl, {a, b, c, d}, uv));
      }
    }
    if (row == bowl.rows / 2) text.line("s 2");
  }
  text.line("g ", bowl.odd_text ? "oeil gauche" : "eye");
  text.line("s off");
  if (bowl.materials) text.line("usemtl eye");
  const int e = grid;
  for (const auto& f : std::vector<std::vector<int>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    text.line(face_line(bowl, {e + f[0], e + f[1], e + f[2], e + f[3]}, 0));
  }
}

}  // namespace

std::string bowl_text(const Bowl& bowl, std::uint64_t person) {
  Text text(bowl);
  text.line("# head ", person);
  if (bowl.odd_text) text.line("#\tv 1 2 3 is no vertex here; grüß Gott");
  if (bowl.materials) text.line("mtllib bowl.mtl");
  text.line(bowl.odd_text ? "o t\xC3\xAAte" : "o head");
  write_vertices(bowl, person, text);
  if (bowl.uvs) write_uvs(bowl, text);
  if (bowl.normals) {
    for (int v = 0; v < bowl.vertex_count(); ++v)
      text.line("vn 0 0.6 ", v % 2 == 0 ? "0.8" : "-0.8");
  }
  text.line("g skin");
  text.line("s 1");
  if (bowl.materials) text.line("usemtl skin");
  write_faces(bowl, text);
  if (bowl.odd_text) {
    text.line("");
    text.line("# the end");
  }
  return std::move(text).text();
}

std::vector<std::string> write_bowls(const std::filesystem::path& folder, const Bowl& bowl,
                                     std::size_t count) {
  const std::vector<std::string> all = {"ann", "bob", "cyd", "dan", "eve", "fay"};
  std::filesystem::create_directories(folder);
  std::vector<std::string> names(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < names.size(); ++i) {
    Bowl own = bowl;
    if (i == 1) own.odd_text = true;
    std::ofstream(folder / (names[i] + ".obj"), std::ios::binary) << bowl_text(own, i + 1);
  }
  return names;
}

reference::Picture mask_picture(std::size_t width, std::size_t height, std::uint64_t seed) {
  reference::Picture picture{width, height, 3, {}};
  for (std::uint64_t texel = 0; texel < width * height; ++texel) {
    const bool black = random_uniform({seed, texel, "black", 0}) < 0.15;
    for (std::uint64_t c = 0; c < 3; ++c) {
      const double value = random_uniform({seed, 3 * texel + c, "texel", 0});
      picture.values.push_back(black ? 0 : std::floor(256 * value) / 255);
    }
  }
  return picture;
}

void write_mask(const std::filesystem::path& path, const reference::Picture& picture,
                bool with_alpha) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t texel = 0; texel < picture.width * picture.height; ++texel) {
    for (std::size_t c = 0; c < picture.channels; ++c) {
      bytes.push_back(static_cast<std::uint8_t>(
          std::lround(255 * picture.values[texel * picture.channels + c])));
    }
    if (with_alpha) bytes.push_back(static_cast<std::uint8_t>(texel * 37 % 256));
  }
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      << encode_png(static_cast<int>(picture.width), static_cast<int>(picture.height),
                    static_cast<int>(picture.channels) + (with_alpha ? 1 : 0), bytes);
}

}  // namespace crowdface::testing
