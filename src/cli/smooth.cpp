// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <vector>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/config/words.h"
#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/iterate.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

struct SmoothOptions : CommonOptions {
  std::string in, out, iterations;
  Boundary boundary = Boundary::kFixed;
  OperatorKind operator_kind = OperatorKind::kUmbrella;
  bool plain = false;
};

/// Parses a list of smoothing levels (numbers of iterations), such as "500,2500"; refuses
/// duplicates.
std::vector<std::uint64_t> levels_of(const std::string& text) {
  std::vector<std::uint64_t> levels;
  for (const std::string_view level : split(text, ',')) {
    levels.push_back(parse_whole_number("--iterations", std::string(level), 0, kMaxIterations));
    if (std::ranges::count(levels, levels.back()) > 1) {
      throw UsageError(concat("--iterations: ", levels.back(), " is given twice"));
    }
  }
  return levels;
}

/// Returns the output file for a smoothing level. If there is only one level, the file is OUT.obj;
/// otherwise the file name contains the level, such as OUT_500.obj.
std::filesystem::path output_of(const SmoothOptions& options, std::uint64_t level, bool alone) {
  if (alone) return options.out;
  const std::filesystem::path path = options.out;
  return path.parent_path() / concat(path.stem().string(), '_', level, path.extension().string());
}

void smooth_file(const SmoothOptions& options) {
  const std::vector<std::uint64_t> levels = levels_of(options.iterations);
  require_obj_output(options.out);
  std::vector<std::filesystem::path> outputs;
  for (const std::uint64_t level : levels) {
    outputs.push_back(checked_output_path(output_of(options, level, levels.size() == 1)));
    refuse_to_write_over({options.in}, {outputs.back()});
  }
  const ObjFile file = read_obj(options.in);
  const SmoothingOperator smoothing(build_adjacency(file.topology), options.boundary,
                                    options.operator_kind);
  std::vector<Positions> results;
  if (options.plain) {
    for (const std::uint64_t level : levels) {
      results.emplace_back(iterate(smoothing, file.positions, level));
    }
  } else {
    results = smooth(ChebyshevFilter(smoothing, file.positions), file.positions, levels);
  }
  for (std::size_t l = 0; l < levels.size(); ++l) {
    write_obj_like(file, file.topology, results[l], outputs[l]);
    log_info(concat(options.in, " smoothed by ", levels[l], " iterations: ", outputs[l].string()));
  }
}

/// Adds an option whose value must be one of the words of the enumeration `Value` (see words_of).
template <class Value>
void add_word_option(CLI::App& command, const char* name, Value& value, const char* help) {
  std::vector<std::string> words;
  for (const auto& word : words_of<Value>()) words.emplace_back(word.text);
  const auto choose = [&value](const std::string& text) {
    for (const auto& word : words_of<Value>()) {
      if (word.text == text) value = word.value;
    }
  };
  add_option(command, name, choose, "WORD", help)
      .one_of(words)
      .show_default(std::string(word_of(value)));
}

void declare_smooth(CLI::App& command, SmoothOptions& options) {
  add_option(command, "input", options.in, "IN.obj", "The mesh").required();
  add_option(command, "--iterations", options.iterations, "L[,L...]",
             "Number of smoothing iterations; several levels (500,2500) are computed in one pass "
             "and written to OUT_500.obj, OUT_2500.obj")
      .required();
  add_option(command, "-o,--output", options.out, "OUT.obj", "The mesh to write").required();
  add_word_option(command, "--boundary", options.boundary,
                  "Keep boundary vertices in place (fixed) or move them (free)");
  add_word_option(
      command, "--operator", options.operator_kind,
      "Move each vertex to the mean of its neighbours (umbrella) or half the way (lazy)");
  add_flag(command, "--plain", options.plain,
           "Run each iteration instead of the polynomial filter; slow, for comparison");
}

}  // namespace

CommandAction add_smooth(CLI::App& program) {
  return add_command(program, "smooth", "Apply the Laplacian smoothing S_L (Eq. 1) to one mesh",
                     declare_smooth, smooth_file);
}

}  // namespace crowdface::cli
