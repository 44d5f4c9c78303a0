// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/input_files.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "crowdface/cast/review.h"
#include "crowdface/config/config_values.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/io/decomposed_text.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/npy_array.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

void add_image(const fs::path& image, std::vector<fs::path>& files) {
  files.push_back(image);
  for (fs::path& tile : find_tiles(image)) files.push_back(std::move(tile));
}

bool is_visible_file(const fs::path& path) {
  return !path.filename().string().starts_with('.') && !is_folder(path);
}

std::vector<fs::path> visible_files(const fs::path& folder,
                                    const std::function<bool(const fs::path&)>& is_wanted) {
  std::error_code error;
  std::vector<fs::path> files = list_files(
      folder, [&](const fs::path& path) { return is_wanted(path) && is_visible_file(path); },
      &error);
  if (!error) return files;
  throw MissingInput(concat("the folder ", quoted(folder.string()),
                            " cannot be read: ", error.message(), advice_on_path(folder)));
}

/// Returns whether a file's extension belongs to a format in which meshes may be stored.
bool may_hold_mesh(const fs::path& path) {
  static const std::set<std::string> endings = {
      ".3ds",  ".3mf",  ".abc", ".blend", ".bgeo", ".c4d", ".dae", ".gz",  ".lwo",
      ".ma",   ".max",  ".mb",  ".npz",   ".off",  ".pkl", ".stl", ".usd", ".usdc",
      ".usdz", ".vrml", ".wrl", ".x3d",   ".zip",  ".zpr", ".ztl"};
  return endings.contains(lower_case(path.extension().string())) || is_head_file(path);
}

/// Returns why a NumPy array cannot be a head: the array has the wrong shape. Returns an empty text
/// for other files.
std::string objection_to_array(const fs::path& file) {
  const bool is_array = lower_case(file.extension().string()) == ".npy";
  const auto shape = is_array ? npy_shape(file) : std::nullopt;
  if (!shape) return {};
  if (shape->size() == 3 && shape->back() == 3 && shape->front() != 1) {
    return concat("it has ", shape->front(), " heads: save each head to its own file");
  }
  // Return no objection to an array of n by 3, which can be a head, nor to an array of 3 by n: the
  // code that reads arrays later refuses an array of 3 by n, with a message that asks for n by 3.
  if (shape->size() >= 2 && (shape->back() == 3 || shape->front() == 3)) return {};
  std::string sizes;
  for (const std::size_t size : *shape) sizes += concat(sizes.empty() ? "" : " by ", size);
  return concat("an array of ", sizes, " is not a list of points");
}

/// Returns a message that names the files that may contain a mesh but are not in `heads`, with the
/// reasons. Empty if there are no such files.
/// \param where  the folder or the pattern, for the message.
/// \param to_read_all  advice on how to read all heads; used if a file not in `heads` may be a
/// head.
std::string left_out_message(const std::string& where, const std::vector<fs::path>& files,
                             const std::vector<fs::path>& heads, const std::string& to_read_all) {
  const bool are_arrays = !heads.empty() && lower_case(heads[0].extension().string()) == ".npy";
  std::vector<std::string> others;
  bool has_heads = false, has_objection = false;
  for (const fs::path& file : files) {
    if (contains(heads, file)) continue;
    const bool is_faces =
        lower_case(file.extension().string()) == ".npy" && !is_head_file(file) && !are_arrays;
    if (!may_hold_mesh(file) && !is_faces) continue;
    const std::string objection = objection_to_array(file);
    has_objection = has_objection || (!objection.empty() && !is_faces);
    has_heads = has_heads || (is_head_file(file) && objection.empty());
    others.push_back(objection.empty() || is_faces
                         ? file.filename().string()
                         : concat(file.filename().string(), " (", objection, ")"));
  }
  if (others.empty()) return {};
  constexpr std::size_t kNamed = 5;
  const std::size_t count = others.size();
  if (count > kNamed) {
    others.resize(kNamed);
    others.emplace_back("…");
  }
  // `to_read_all` advises the user to select the heads by a file name pattern. Leave this advice
  // out if no file has a format that crowdface can read as a head.
  return concat(quoted(where), ": left out ", count == 1 ? "is " : "are ", join(others), " (",
                count, ")",
                has_heads       ? to_read_all
                : has_objection ? ""
                                : ": crowdface cannot read this format; export the heads as OBJ");
}

/// Returns whether a name matches a pattern with the wildcards `*` and `?`. After a mismatch, the
/// most recent asterisk takes one more character of the name. Earlier asterisks keep their
/// characters, so the number of steps is at most the product of the two lengths.
bool matches_wildcards(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, after_asterisk = pattern.npos, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      after_asterisk = ++p;
      taken = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (after_asterisk != pattern.npos) {
      p = after_asterisk;
      n = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == pattern.npos;
}

}  // namespace

std::vector<fs::path> list_heads(const fs::path& folder) {
  const auto ending_of = [](const fs::path& file) {
    const std::string ending = lower_case(file.extension().string());
    return ending == ".gltf" ? ".glb" : ending;
  };
  std::vector<fs::path> files = visible_files(folder, is_head_file);
  std::erase_if(files, [](const fs::path& file) { return !objection_to_array(file).empty(); });
  // If there are fewer than two OBJ files, find the most frequent format; OBJ wins a tie.
  std::map<std::string, std::size_t> counts;
  for (const fs::path& file : files) ++counts[ending_of(file)];
  std::string kind = ".obj";
  if (counts[kind] < kMinHeads) {
    for (const auto& [ending, count] : counts) {
      if (count > counts[kind]) kind = ending;
    }
  }
  // Remove all files that are neither OBJ files nor files of the most frequent format. Of the files
  // of this format, also remove each file with the same stem as an OBJ file.
  std::set<std::string> obj_stems;
  for (const fs::path& file : files) {
    if (is_obj(file)) obj_stems.insert(file.stem().string());
  }
  std::erase_if(files, [&](const fs::path& file) {
    return !is_obj(file) && (ending_of(file) != kind || obj_stems.contains(file.stem().string()));
  });
  return files;
}

std::string left_out_meshes_message(const fs::path& folder) {
  const auto any = [](const fs::path&) { return true; };
  return left_out_message(
      folder.string(), visible_files(folder, any), list_heads(folder),
      concat(": the heads of a folder are its OBJ files, or the files of the most frequent format; "
             "to read other formats too, write files: \"",
             (folder.filename() / "*").string(),
             "\", or convert the files with crowdface convert"));
}

std::vector<fs::path> heads_matching(const fs::path& pattern, std::string& left_out) {
  const std::vector<fs::path> files = files_matching(pattern);
  std::vector<fs::path> heads = files;
  std::erase_if(heads, [](const fs::path& file) {
    return !is_head_file(file) || !objection_to_array(file).empty();
  });
  left_out = left_out_message(pattern.string(), files, heads, "");
  return heads;
}

std::vector<fs::path> files_matching(const fs::path& pattern) {
  std::vector<fs::path> found = {fs::path()};
  for (const fs::path& part : pattern) {
    const std::string text = part.string();
    std::vector<fs::path> next;
    for (const fs::path& folder : found) {
      if (text.find_first_of("*?") == text.npos) {
        next.push_back(folder / part);
        continue;
      }
      if (!is_folder(folder.empty() ? "." : folder)) continue;
      for (const fs::path& entry : list_folder(folder.empty() ? "." : folder)) {
        const std::string name = entry.filename().string();
        if (!name.starts_with('.') && matches_wildcards(text, name)) next.push_back(folder / name);
      }
    }
    found = std::move(next);
  }
  std::erase_if(found, [](const fs::path& path) { return !is_file(path); });
  std::ranges::sort(found);
  return found;
}

std::string valid_head_name(const std::string& stem) {
  std::string name;
  for (const char c : decomposed(stem)) {
    const bool is_mark = (static_cast<unsigned char>(c) & 0xFEU) == 0xCCU;
    if (is_valid_name(concat('a', c))) {
      name += c;
    } else if (!is_utf8_continuation(c) && !is_mark) {
      name += '_';
    }
  }
  return name;
}

std::vector<std::string> names_of_heads(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(valid_head_name(file.stem().string()));
  const auto all_differ = [&] {
    return std::set(names.begin(), names.end()).size() == names.size();
  };
  if (all_differ() || files.empty()) return names;
  // Split the paths at the separators. If the paths do not all have the same number of parts, the
  // parts cannot be compared.
  std::vector<std::vector<std::string>> parts;
  for (const fs::path& file : files) {
    const fs::path plain = file.lexically_normal();
    std::vector<std::string>& of = parts.emplace_back();
    for (const fs::path& part : plain.parent_path()) of.push_back(valid_head_name(part.string()));
    of.push_back(valid_head_name(plain.stem().string()));
    if (of.size() != parts[0].size()) return names;
  }
  // Build each name from the path parts that are not equal in all paths, such as "ann_smile". Add
  // parts in order, beginning at the root, and stop as soon as all names are different.
  const std::vector<std::string> stems = names;
  names.assign(files.size(), "");
  for (std::size_t p = 0; p < parts[0].size() && !all_differ(); ++p) {
    if (std::ranges::all_of(parts, [&](const auto& of) { return of[p] == parts[0][p]; })) continue;
    for (std::size_t h = 0; h < names.size(); ++h) {
      names[h] += concat(names[h].empty() ? "" : "_", parts[h][p]);
    }
  }
  return all_differ() ? names : stems;
}

std::vector<fs::path> input_files(const Config& config) {
  std::vector<fs::path> files = {config.file};
  const auto add = [&](const fs::path& file) {
    if (!file.empty()) files.push_back(file);
  };
  std::ranges::for_each(config.faces.files, add);
  add(config.shapes.neutral);
  std::ranges::for_each(config.shapes.template_files, add);
  for (const auto& of_head : config.shapes.head_files) std::ranges::for_each(of_head, add);
  add(config.points);
  add(config.landmarks);
  add(config.population.file);
  add(config.quantile_table.file);
  add(config.rig);
  add(config.neck.body);
  add(config.neck.rim);
  add(config.neck.body_rim);
  add(config.neck.body_texture);
  std::ranges::for_each(config.tag_and_attachment_files, add);
  add(config.attachments.file);
  for (const Config::Attachment& item : config.attachments.items) add(item.file);
  for (const std::string& mask : config.regions.mask) add_image(mask, files);
  if (config.distance.mask) add_image(*config.distance.mask, files);
  std::ranges::for_each(config.review.files, add);
  add(config.edits);
  if (const auto& sheet = config.output.contact_sheet) add(sheet->compare.file);
  return files;
}

void require_storable_path(const fs::path& path) {
  if (is_utf8(path.native()) && !has_control_character(path.native())) return;
  throw UsageError(concat(
      quoted(path.native()),
      ": expected a path of UTF-8 text without control characters, because a config must name it"));
}

void check_paths(const Config& config, Problems& problems) {
  std::vector<fs::path> paths = input_files(config);
  paths.push_back(config.output.directory);
  for (const fs::path& path : paths) {
    std::error_code ignored;
    try {
      require_storable_path(fs::absolute(path, ignored));
    } catch (const UsageError& error) {
      problems.add(error);
    }
  }
}

std::string suggested_head_pattern(const fs::path& folder) {
  for (const fs::path& below : list_folder(folder)) {
    if (!is_folder(below)) continue;
    std::vector<fs::path> inner = {below};
    for (const fs::path& entry : list_folder(below)) {
      if (is_folder(entry)) inner.push_back(entry);
    }
    for (const fs::path& at : inner) {
      const std::vector<fs::path> heads = list_heads(at);
      if (heads.empty()) continue;
      const fs::path name = heads.front().filename();
      for (const fs::path& last : {name, fs::path(concat("*", name.extension().string()))}) {
        const fs::path pattern = folder / "*" / (at / last).lexically_relative(below);
        if (files_matching(pattern).size() < kMinHeads) continue;
        return concat("; if each head has its own folder, set faces.files: \"",
                      (folder.filename() / pattern.lexically_relative(folder)).string(),
                      "\" in the config");
      }
    }
  }
  return {};
}

std::string advice_on_path(const fs::path& path) {
  const std::string text = path.string();
  if (text.find('\\') != text.npos) return "; write paths with / instead of \\";
  if (text.find("<udim>") != text.npos) return "; write <UDIM> in capital letters";
  const auto key = [](const fs::path& name) { return lower_case(decomposed(name.string())); };
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (const fs::path& entry : list_folder(folder, &ignored)) {
    const std::string name = entry.filename().string();
    if (key(name) != key(path.filename())) continue;
    return decomposed(name) == decomposed(path.filename().string())
               ? "; a file has this name, but its accents are encoded in another way (as macOS "
                 "does): rename the file"
               : concat("; did you mean ", quoted(name), "?");
  }
  return {};
}

std::string objection_to_head_name(const std::string& name, const fs::path& file,
                                   const std::vector<std::string>& other_names) {
  const std::string quoted_file = quoted(file.string());
  if (!is_valid_name(name)) {
    return concat("the head's name, ", quoted(name),
                  ", comes from its file name; expected at most 64 letters (a-z), digits, '_', '-' "
                  "and '.'; rename ",
                  quoted_file);
  }
  if (name == "all" || name == "target") {
    return concat("a head cannot have the name ", quoted(name),
                  ", because the word is reserved; rename ", quoted_file);
  }
  if (contains(other_names, name)) {
    return concat("two heads are called ", quoted(name), "; rename the second, ", quoted_file);
  }
  return {};
}

}  // namespace crowdface
