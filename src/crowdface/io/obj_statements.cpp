// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_statements.h"

#include <algorithm>
#include <array>

namespace crowdface {
namespace {

/// OBJ statements whose content this program does not use; it copies them unchanged.
constexpr std::array<std::string_view, 31> kOtherStatements = {
    "g",        "s",        "o",    "usemtl", "mtllib", "l",          "p",        "vp",
    "cstype",   "deg",      "bmat", "step",   "curv",   "curv2",      "surf",     "parm",
    "trim",     "hole",     "scrv", "sp",     "end",    "con",        "mg",       "bevel",
    "c_interp", "d_interp", "lod",  "usemap", "maplib", "shadow_obj", "trace_obj"};

}  // namespace

bool is_obj_statement(std::string_view word) {
  return word == "v" || word == "vt" || word == "vn" || word == "f" ||
         std::ranges::find(kOtherStatements, word) != kOtherStatements.end();
}

std::string_view first_obj_word(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(kObjBlanks), line.size());
  return line.substr(begin, std::min(line.find_first_of(kObjBlanks, begin), line.size()) - begin);
}

std::string_view next_obj_line(std::string_view text, std::size_t& at) {
  const std::size_t end = std::min(text.find('\n', at), text.size());
  const std::string_view line = text.substr(at, end - at);
  at = end + 1;
  return line;
}

bool is_continued(std::string_view text, std::string_view line) {
  if (!line.ends_with('\\')) return false;
  const std::string_view statement = first_obj_word(line);
  if (statement.starts_with('#')) return false;
  constexpr std::array<std::string_view, 4> kNaming = {"usemtl", "g", "o", "mtllib"};
  if (std::ranges::find(kNaming, statement) == kNaming.end()) return true;
  std::size_t at =
      std::min(text.find('\n', static_cast<std::size_t>(line.data() - text.data()) + line.size()),
               text.size());
  ++at;
  if (at >= text.size()) return false;
  const std::string_view next = first_obj_word(next_obj_line(text, at));
  return !next.empty() && !next.starts_with('#') && !is_obj_statement(next);
}

}  // namespace crowdface
