// SPDX-License-Identifier: Apache-2.0
#include "support/small_crowd.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

#include "support/crowd_files.h"

namespace crowdface::testing {
namespace {

/// The line without the x y z that follow its first word.
std::string without_numbers(const std::string& line) {
  const std::size_t word = line.find_first_not_of(" \t");
  const std::size_t first = line.find_first_not_of(" \t", line.find_first_of(" \t", word));
  std::size_t end = first;
  for (int i = 0; i < 3; ++i) {
    end = std::min(line.find_first_of(" \t\r", line.find_first_not_of(" \t", end)), line.size());
  }
  return line.substr(0, first) + "…" + line.substr(end);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  lines.emplace_back(text.ends_with('\n') ? "ends with a line end" : "does not");
  return lines;
}

}  // namespace

std::vector<std::string> SmallCrowd::region_names() const {
  if (regions == 0) return {"all"};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < regions; ++k) names.push_back(concat("region_", k + 1));
  return names;
}

SmallCrowdFolder::SmallCrowdFolder(const SmallCrowd& crowd) {
  set_log_level(LogLevel::kQuiet);
  names_ = write_bowls(folder_ / "heads", crowd.bowl, crowd.heads);
  const std::size_t images = (crowd.regions + 2) / 3;
  for (std::size_t image = 0; image < images; ++image) {
    reference::Mask& mask = masks_.emplace_back();
    for (int tile = 0; tile < (crowd.udim ? crowd.bowl.tiles : 1); ++tile) {
      const int number = crowd.udim ? 1001 + tile : 0;
      const auto seed = static_cast<std::uint64_t>(number) + 100 * image;
      mask[number] = mask_picture(13 + image, 9, seed);
      write_mask(folder_ / (crowd.udim ? concat("mask_", image, '.', number, ".png")
                                       : concat("mask_", image, ".png")),
                 mask[number], crowd.alpha);
    }
  }
  configure(crowd);
}

void SmallCrowdFolder::configure(const SmallCrowd& crowd) {
  crowd_ = crowd;
  std::vector<std::string> masks;
  for (std::size_t image = 0; image < masks_.size(); ++image) {
    masks.push_back(concat("mask_", image, crowd.udim ? ".<UDIM>.png" : ".png"));
  }
  const std::string regions = crowd.regions == 0 ? "none"
                                                 : concat("{names: [", join(crowd.region_names()),
                                                          "], mask: [", join(masks), "]}");
  folder_.write(
      "config.yaml",
      concat("schema: 1\ncrowd: {name: mob, count: ", crowd.count, ", seed: ", crowd.seed,
             "}\nfaces: {directory: heads, units: ", crowd.units, ", align: none}", "\nregions: ",
             regions, "\nsmoothing: {", crowd.smoothing_limit, ", boundary: ", crowd.boundary,
             ", operator: ", crowd.operator_kind, ", levels: ", crowd.levels,
             "}\nblending: {contacts: none, normalization: ", crowd.normalization,
             "}\nparts: ", crowd.parts, "\nsampling: ", crowd.sampling,
             "\noutput: {directory: out, contact_sheet: ", crowd.contact_sheet, "}\n", crowd.more));
}

reference::Heads SmallCrowdFolder::reference_heads() const {
  reference::Heads heads;
  reference::Obj mesh;
  for (const std::string& name : names_) {
    mesh = reference::read_obj(head(name));
    heads.positions[name] = mesh.vertices;
  }
  heads.filter =
      reference::make_filter(mesh, crowd_.boundary == "fixed", crowd_.operator_kind == "lazy");
  heads.regions = crowd_.region_names();
  heads.alpha = crowd_.regions == 0 ? std::vector<std::vector<double>>(mesh.vertices.size(), {1.0})
                                    : reference::masks_at_vertices(mesh, masks_, crowd_.regions);
  return heads;
}

void run(const SmallCrowdFolder& folder, const std::vector<std::string>& set, Replace replace) {
  run(folder, ConfigOverrides{set, {}, {}, {}}, replace);
}

void run(const SmallCrowdFolder& folder, const ConfigOverrides& overrides, Replace replace) {
  generate(folder.config(), overrides, {folder.cache(), replace, false});
}

void run_to(const SmallCrowdFolder& folder, const std::string& out, ConfigOverrides overrides,
            Replace replace) {
  overrides.out = (folder / out).string();
  run(folder, overrides, replace);
}

void expect_meshes_match_plan(const SmallCrowdFolder& folder, const std::filesystem::path& out) {
  const reference::Heads heads = folder.reference_heads();
  // Single precision; fitted levels may miss each of the two heads' worth of detail by 0.05 mm.
  const double tolerance =
      (folder.crowd().levels == "basis"   ? 0.012
       : folder.crowd().levels == "cubic" ? 1.2e-3  // fields in 16 bits, in steps of powers of two
                                          : 2e-5) *
      folder.crowd().bowl.per_cm;
  std::map<std::string, reference::Cubics> cubics;
  if (folder.crowd().levels == "cubic") {
    const auto max_level =
        read_json(out / "report.json").at("smoothing").at("max_iterations").get<std::uint64_t>();
    for (const auto& [name, positions] : heads.positions) {
      cubics[name] = reference::fit_cubics(heads.filter, positions, max_level);
    }
  }
  const auto lines = plan_lines(out);
  EXPECT_FALSE(lines.empty());
  for (const auto& line : lines) {
    const auto path = out / "meshes" / (line.at("id").get<std::string>() + ".obj");
    const reference::Points expected =
        cubics.empty() ? reference::blend(heads, line) : reference::blend(heads, cubics, line);
    EXPECT_LT(reference::largest_difference(reference::read_obj(path).vertices, expected),
              tolerance)
        << line.dump();
    expect_same_but_positions(folder.head(line.at("target").get<std::string>()), path);
  }
}

void expect_weights_match_positions(const SmallCrowdFolder& folder,
                                    const std::filesystem::path& out) {
  const nlohmann::json report = read_json(out / "report.json");
  std::vector<std::pair<std::string, std::array<double, 2>>> anchors;
  for (const auto& head : report.at("heads")) {
    anchors.emplace_back(head.at("name").get<std::string>(),
                         head.at("anchor").get<std::array<double, 2>>());
  }
  const bool printed = folder.crowd().normalization == "printed";
  for (const auto& line : plan_lines(out)) {
    for (const auto& [region, values] : line.at("regions").items()) {
      if (values.at("position").is_null()) continue;
      const auto expected = reference::weights_at_position(
          anchors, line.at("target").get<std::string>(), folder.names(),
          values.at("position").get<std::array<double, 2>>(), printed, 3);
      const auto found = values.at("weights").get<std::map<std::string, double>>();
      ASSERT_EQ(found.size(), expected.size()) << line.dump();
      for (const auto& [name, weight] : expected) {
        ASSERT_TRUE(found.contains(name)) << line.dump();
        EXPECT_NEAR(found.at(name), weight, 1e-12) << line.dump();
      }
    }
  }
}

void expect_same_but_positions(const std::filesystem::path& target,
                               const std::filesystem::path& result) {
  const std::vector<std::string> expected = lines_of(read_text(target));
  const std::vector<std::string> found = lines_of(read_text(result));
  ASSERT_EQ(found.size(), expected.size()) << result;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::size_t word = expected[i].find_first_not_of(" \t");
    const bool numbers = word != std::string::npos && (expected[i].compare(word, 2, "v ") == 0 ||
                                                       expected[i].compare(word, 3, "vn ") == 0);
    ASSERT_EQ(numbers ? without_numbers(found[i]) : found[i],
              numbers ? without_numbers(expected[i]) : expected[i])
        << result << " line " << i + 1;
  }
}

}  // namespace crowdface::testing
