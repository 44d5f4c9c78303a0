// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/smooth/chebyshev.h"
#include "crowdface/smooth/iterate.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

constexpr std::uint64_t kMostIterations = 10'000'000;

struct Options {
  CommonOptions common;
  std::string in, out, iterations;
  std::string boundary = "fixed", operator_kind = "umbrella";
  bool plain = false;
};

void smooth_file(const Options& options) {
  const std::uint64_t level = whole_number("--iterations", options.iterations, 0, kMostIterations);
  const ObjFile file = read_obj(options.in);
  const SmoothingOperator smoothing(
      build_adjacency(file.topology),
      options.boundary == "free" ? Boundary::kFree : Boundary::kFixed,
      options.operator_kind == "lazy" ? OperatorKind::kLazy : OperatorKind::kUmbrella);
  const Positions result = options.plain ? Positions(iterate(smoothing, file.positions, level))
                                         : smooth(smoothing, file.positions, level);
  write_obj_like(file, file.topology, result, options.out);
  log_info(concat(options.in, " smoothed by ", level, " iterations: ", options.out));
}

}  // namespace

Run add_smooth(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("smooth", "Laplacian smoothing on its own: S_L of one mesh (Eq. 1)");
  command->add_option("input", options->in, "The mesh")->required()->type_name("IN.obj");
  command->add_option("--iterations", options->iterations, "How often the one-ring mean is taken")
      ->required()
      ->type_name("L");
  command->add_option("-o,--output", options->out, "The mesh to write")
      ->required()
      ->type_name("OUT.obj");
  command->add_option("--boundary", options->boundary, "Open rims stay (fixed) or move (free)")
      ->check(CLI::IsMember({"fixed", "free"}))
      ->capture_default_str();
  command
      ->add_option("--operator", options->operator_kind,
                   "The mean of the neighbours (umbrella), or half-way to it (lazy)")
      ->check(CLI::IsMember({"umbrella", "lazy"}))
      ->capture_default_str();
  command->add_flag("--plain", options->plain,
                    "Iterate one by one instead of filtering: slow, for comparison");
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    smooth_file(*options);
  };
}

}  // namespace crowdface::cli
