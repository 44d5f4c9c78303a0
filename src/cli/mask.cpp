// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "crowdface/config/config_reader.h"
#include "crowdface/config/input_files.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/load_inputs.h"
#include "crowdface/paint/proposed_masks.h"

#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/head_files.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMinSize = 64, kMaxSize = 8192;

struct MaskOptions : CommonOptions {
  std::string heads, out, bands = "brow,nose,mouth", size, up, front;
  CacheOption cache;
  bool force = false;
};

/// The heads to mask. Also the up and front axes of the heads, if a config defines these axes.
struct MaskInputs {
  Config::Faces faces;
  std::optional<Orientation> orientation;
};

MaskInputs heads_of_folder(const fs::path& folder) {
  MaskInputs wanted;
  wanted.faces.files = list_heads(folder);
  if (wanted.faces.files.empty()) {
    throw MissingInput(concat(
        folder.string(), ": expected heads (OBJ, PLY, GLB, glTF, FBX, USD, NumPy), found none"));
  }
  for (const fs::path& file : wanted.faces.files) {
    wanted.faces.names.push_back(file.stem().string());
  }
  return wanted;
}

/// Reads the heads that a config names. Ignores problems in the rest of the config: for example,
/// the mask file that the config names may not exist yet.
MaskInputs heads_of_config(const fs::path& file) {
  Problems problems;
  const ConfigReading reading = read_partial_config(file, {}, problems);
  if (!reading.are_heads_known) problems.throw_if_any();
  const Config::Faces& faces = reading.config.faces;
  return {faces, Orientation{faces.up, faces.front}};
}

void read_axis(const std::string& option, const std::string& text, Axis& axis) {
  if (text.empty()) return;
  const auto read = parse_axis(text);
  if (!read)
    throw UsageError(concat(option, ": expected an axis such as +Z, found ", quoted(text)));
  axis = *read;
}

Orientation bearing_of(const MaskOptions& options, const MaskInputs& wanted,
                       const Topology& topology, const HeadShape& mean) {
  Orientation orientation = wanted.orientation.value_or(Orientation{{1, 1}, {2, 1}});
  if (options.up.empty() && options.front.empty() && !wanted.orientation) {
    return find_orientation(topology, mean).value_or(orientation);
  }
  read_axis("--up", options.up, orientation.up);
  read_axis("--front", options.front, orientation.front);
  if (orientation.up.index == orientation.front.index) {
    throw UsageError("--up, --front: expected two different axes");
  }
  return orientation;
}

void mask(const MaskOptions& options) {
  const std::vector<MaskBand> bands = parse_bands(options.bands);
  const fs::path out = options.out;
  if (out.extension() != ".png") {
    throw UsageError(concat("-o: expected a PNG file, found ", quoted(options.out)));
  }
  const MaskInputs wanted =
      is_folder(options.heads) ? heads_of_folder(options.heads) : heads_of_config(options.heads);
  Problems problems;
  const auto faces = load_head_set(wanted.faces, options.cache.cache_path(), problems);
  problems.throw_if_any();
  const HeadShape mean = mean_head_shape(*faces);
  const Orientation orientation = bearing_of(options, wanted, faces->topology, mean);
  const int size =
      options.size.empty()
          ? mask_side_texels(faces->topology.vertex_count)
          : static_cast<int>(parse_whole_number("--size", options.size, kMinSize, kMaxSize));
  MaskFiles masks = encode_masks(propose_masks(*faces, mean, orientation, bands, size), out);
  std::vector<HeadFile> files;
  for (auto& [file, bytes] : masks.png_files) files.push_back(text_file(file, std::move(bytes)));
  write_head_files("masks", files, options.force);
  std::vector<std::string> paths;
  for (const fs::path& path : masks.mask_paths) paths.push_back(write_scalar(path.string()));
  const std::string list = join(paths);
  print(concat("regions: {names: [", join(names_of(bands)),
               "], mask: ", paths.size() > 1 ? concat('[', list, ']') : list, "}\n"));
  log_info(concat("the heads look along ", name_of(orientation.front), " with ",
                  name_of(orientation.up),
                  " up; to see the regions, run crowdface check CONFIG --masks DIR"));
}

void declare_mask(CLI::App& command, MaskOptions& options) {
  add_option(command, "heads", options.heads, "HEADS_DIR|CONFIG", "A folder of heads, or a config")
      .required();
  add_option(command, "-o,--output", options.out, "FILE.png",
             "The mask to write; the number of a UDIM tile precedes the file extension")
      .required();
  add_option(command, "--bands", options.bands, "LIST",
             "The regions, in this order: brow,nose,mouth and optionally ears and neck");
  add_option(command, "--size", options.size, "N",
             "Texels per side, 64 to 8192 (default: 1024, or 2048 for large meshes)");
  add_option(command, "--up", options.up, "AXIS", "The up axis of the heads, such as +Z");
  add_option(
      command, "--front", options.front, "AXIS",
      "The axis along which the heads look (default for a folder: detected from their shape)");
  options.cache.add_to(command);
  add_flag(command, "--force", options.force, "Replace existing images with other contents");
}

}  // namespace

CommandAction add_mask(CLI::App& program) {
  return add_command(program, "mask",
                     "Propose a mask of the regions brow, nose and mouth from the heads' shape",
                     declare_mask, mask);
}

}  // namespace crowdface::cli
