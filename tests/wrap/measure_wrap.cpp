// SPDX-License-Identifier: Apache-2.0
// How well `wrap` finds heads again: each becomes a scan, is wrapped by a template that does not
// know it, and is compared with its own vertices. scripts/measure_wrap.sh runs this.
//   crowdface_measure_wrap HEADS_DIR [HEAD …] [--templates one,mean,model] [--estimate]
//                          [--landmarks picked|found|none] [--next N]
// N: the template "one" is the head N after the scanned head.
// Heads are numbered from 0 in the order of their names; seconds are of processor time.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/pick/found_landmarks.h"
#include "crowdface/pick/proposed_landmarks.h"
#include "crowdface/validity/triangles.h"
#include "crowdface/wrap/feature_check.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/scan_face.h"
#include "crowdface/wrap/wrap.h"

#include "wrap/truth_scan.h"

namespace {

namespace fs = std::filesystem;
using namespace crowdface;

/// Landmarks on the ICT face model: corners and middles of lids and lips, brows, nose, chin, ears.
const std::vector<WrapLandmark> kIctLandmarks = {{"chin", 966, {}},
                                                 {"nasion", 978, {}},
                                                 {"nose_tip", 4857, {}},
                                                 {"subnasale", 1147, {}},
                                                 {"nostril_right", 1140, {}},
                                                 {"nostril_left", 3360, {}},
                                                 {"eye_right_outer", 1507, {}},
                                                 {"eye_right_inner", 1528, {}},
                                                 {"eye_left_inner", 3742, {}},
                                                 {"eye_left_outer", 3721, {}},
                                                 {"lid_right_upper", 1537, {}},
                                                 {"lid_left_upper", 3751, {}},
                                                 {"lid_right_lower", 1518, {}},
                                                 {"lid_left_lower", 3732, {}},
                                                 {"mouth_right", 5708, {}},
                                                 {"mouth_left", 6213, {}},
                                                 {"lip_upper", 0, {}},
                                                 {"lip_lower", 5518, {}},
                                                 {"brow_right", 268, {}},
                                                 {"brow_left", 2509, {}},
                                                 {"lobe_left", 7125, {}},
                                                 {"lobe_right", 7447, {}},
                                                 {"ear_left", 7238, {}},
                                                 {"ear_right", 7965, {}}};

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double distance_to_line(const Eigen::Vector3d& p, const std::vector<Eigen::Vector3d>& line) {
  double best = 1e300;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d& a = line[i];
    const Eigen::Vector3d d = line[(i + 1) % line.size()] - a;
    const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - a - t * d).norm());
  }
  return best;
}

/// Which of the measured regions each vertex of the head's skin belongs to.
struct Regions {
  std::vector<bool> skin, face, eyes, lips;
};

Regions regions_of(const WrapTemplate& head, const std::map<std::string, std::uint32_t>& marks) {
  const auto at = [&](const char* name) -> Eigen::Vector3d {
    return head.positions.row(marks.at(name)).transpose();
  };
  const Eigen::Vector3d middle = at("subnasale");
  const Eigen::Vector3d right = (at("eye_right_outer") + at("eye_right_inner")) / 2;
  const Eigen::Vector3d left = (at("eye_left_outer") + at("eye_left_inner")) / 2;
  const std::vector<Eigen::Vector3d> mouth = {at("mouth_right"), at("lip_upper"), at("mouth_left"),
                                              at("lip_lower")};
  Regions regions;
  for (std::size_t i = 0; i < head.skin.vertices.size(); ++i) {
    const Eigen::Vector3d p = head.positions.row(head.skin.vertices[i]).transpose();
    const bool seen = head.skin.ambient_visibility[i] > 0.12;
    regions.skin.push_back(seen);
    regions.face.push_back(seen && (p - middle).norm() < 90);
    regions.eyes.push_back(seen && std::min((p - right).norm(), (p - left).norm()) < 22);
    regions.lips.push_back(seen && distance_to_line(p, mouth) < 6);
  }
  return regions;
}

/// Lips whose median error is larger are wrong.
constexpr double kWrongLipsMm = 5;

struct Measured {
  std::vector<double> skin, face, eyes, lips, surface;
  Index folded_triangle_count = 0;
  double seconds = 0;
  std::string notes = {};  ///< what the program says of this head
};

void print_row(const std::string& name, const Measured& m) {
  std::printf("%-22s %5.2f /%5.2f  %5.2f /%5.2f  %5.2f  %5.2f  %5.2f  %4ld  %5.1f s\n",
              name.c_str(), percentile(m.skin, 0.5), percentile(m.skin, 0.95),
              percentile(m.face, 0.5), percentile(m.face, 0.95), percentile(m.eyes, 0.5),
              percentile(m.lips, 0.5), percentile(m.surface, 0.95),
              static_cast<long>(m.folded_triangle_count), m.seconds);
  if (!m.notes.empty()) std::printf("%s", m.notes.c_str());
  std::fflush(stdout);
}

void add(const std::vector<double>& from, std::vector<double>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

Measured measure(const WrapTemplate& shape, const ShapeModel* model, const WrapTemplate& head,
                 const testing::TruthScan& truth, const Regions& regions, const std::string& used) {
  const std::clock_t start = std::clock();
  Measured m;
  std::optional<PoseHint> hint;
  std::vector<WrapLandmark> landmarks = truth.landmarks;
  const auto marks_here = propose_landmarks(shape);
  if (used != "picked") {
    const auto face = find_scan_face(truth.scan, hint);
    if (!face) {
      m.notes = "  no face found\n";
      return m;
    }
    hint = PoseHint{face->axes.up, face->axes.front, face};
    landmarks.clear();
    if (used == "found") {
      landmarks = find_landmarks(shape, marks_here, truth.scan, *hint);
    }
  }
  const WrapResult result =
      wrap_checked(shape, model, face_features(shape, marks_here), truth.scan, landmarks, hint);
  m.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (used != "picked") {
    for (const LandmarkResidual& landmark : result.landmarks) {
      const auto at = std::ranges::find(landmarks, landmark.name, &WrapLandmark::name);
      const Eigen::Vector3d there = row3(truth.pose.apply(head.positions), at->vertex);
      m.notes += concat("  ", landmark.name, ": detected ",
                        format_fixed((there - at->scan_position).norm() / truth.pose.scale, 1),
                        " mm from its place, ends ", format_fixed(landmark.final_distance_mm, 1),
                        " mm from where it was detected\n");
    }
    m.notes += "  agreement:";
    for (const FeatureCheck& feature : result.features) {
      m.notes += concat(" ", feature.name, " ",
                        format_fixed(feature.correlation.correlation_at_feature, 2));
    }
    m.notes += concat(", dropped ", result.dropped_landmarks.size(), "\n");
    const SkinRegions named = face_regions(shape);
    for (const std::string& warning : wrap_warnings(shape, result, named, 0)) {
      m.notes += concat("  warning: ", warning, "\n");
    }
    try {
      refuse_bad_wrap(shape, result, named);
    } catch (const InvalidInput& error) {
      m.notes += concat("  refused: ", error.what(), "\n");
    }
  }
  const Positions found = inverse(truth.pose).apply(result.pose.apply(result.positions));
  for (std::size_t i = 0; i < head.skin.vertices.size(); ++i) {
    const auto v = static_cast<Index>(head.skin.vertices[i]);
    const double error = (found.row(v) - head.positions.row(v)).norm();
    if (regions.skin[i]) m.skin.push_back(error);
    if (regions.face[i]) m.face.push_back(error);
    if (regions.eyes[i]) m.eyes.push_back(error);
    if (regions.lips[i]) m.lips.push_back(error);
    if (regions.skin[i] && !result.lacks_data[i]) {
      m.surface.push_back(result.distance_mm(static_cast<Index>(i)));
    }
  }
  m.folded_triangle_count =
      TargetTriangles(shape.skin.triangles, shape.skin.rows_of(shape.positions))
          .compare(shape.skin.rows_of(result.positions))
          .flipped_triangle_count;
  return m;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(
        stderr,
        "usage: crowdface_measure_wrap HEADS_DIR [HEAD …] [--templates LIST] [--estimate]\n");
    return 64;
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(argv[1])) {
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::size_t> chosen;
  std::string templates = "one,mean,model", landmarks = "picked";
  bool estimate = false;
  std::size_t next = 1;
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "--templates") == 0 && i + 1 < argc) {
      templates = argv[++i];
    } else if (std::strcmp(argv[i], "--next") == 0 && i + 1 < argc) {
      next = parse_unsigned(argv[++i]).value_or(1);
    } else if (std::strcmp(argv[i], "--landmarks") == 0 && i + 1 < argc) {
      landmarks = argv[++i];
    } else if (std::strcmp(argv[i], "--estimate") == 0) {
      estimate = true;
    } else if (const auto number = parse_unsigned(argv[i]); number && *number < files.size()) {
      chosen.push_back(*number);
    }
  }
  if (chosen.empty()) chosen = {0, 4, 5, 9, 10};
  Topology topology;
  std::vector<Positions> heads;
  for (const fs::path& file : files) {
    const ObjFile obj = read_obj(file);
    if (heads.empty()) topology = obj.topology;
    heads.emplace_back(obj.positions * 10);
  }
  std::map<std::string, std::uint32_t> marks;
  for (const WrapLandmark& landmark : kIctLandmarks) marks[landmark.name] = landmark.vertex;

  std::map<std::string, Measured> all;
  std::map<std::string, int> wrong_lips;
  std::printf("%-22s %-13s %-13s %-6s %-6s %-6s flips\n", "template", "all skin", "face", "eyes",
              "lips", "to scan");
  for (const std::size_t h : chosen) {
    const WrapTemplate head = make_template(topology, heads[h], {});
    const testing::TruthScan truth = testing::make_truth_scan(
        head, kIctLandmarks, {.fused = landmarks != "picked", .seed = h + 1});
    const Regions regions = regions_of(head, marks);
    std::vector<Positions> others;
    for (std::size_t i = 0; i < heads.size(); ++i) {
      if (i != h) others.push_back(heads[i]);
    }
    const auto print_estimate = [&](const WrapTemplate& shape, const ShapeModel& model) {
      std::vector<double> off;
      for (const auto& [name, mm] :
           cross_validate_wrap(shape, &model, truth.scan, truth.landmarks, std::nullopt)) {
        off.push_back(mm);
      }
      std::printf(
          "  landmarks that it does not know end %.2f / %.2f mm from where they were picked\n",
          percentile(off, 0.5), percentile(off, 0.95));
    };
    const auto run = [&](const char* name, const WrapTemplate& shape, const ShapeModel* model) {
      if (templates.find(name) == std::string::npos) return;
      const Measured m = measure(shape, model, head, truth, regions, landmarks);
      print_row(concat(name, " for ", h), m);
      if (m.lips.empty() || percentile(m.lips, 0.5) > kWrongLipsMm) ++wrong_lips[name];
      Measured& sum = all[name];
      add(m.skin, sum.skin);
      add(m.face, sum.face);
      add(m.eyes, sum.eyes);
      add(m.lips, sum.lips);
      add(m.surface, sum.surface);
      sum.folded_triangle_count += m.folded_triangle_count;
      sum.seconds += m.seconds / static_cast<double>(chosen.size());
    };
    run("one", make_template(topology, heads[(h + next) % heads.size()], {}), nullptr);
    const ShapeModel whole = make_shape_model(others);
    const WrapTemplate mean = make_template(topology, whole.mean, {});
    run("mean", mean, nullptr);
    const ShapeModel of_skin = skin_model(whole, mean);
    run("model", mean, &of_skin);
    if (estimate) print_estimate(mean, of_skin);
  }
  for (const auto& [name, m] : all) {
    print_row(concat(name, ", all"), m);
    std::printf("  %d of %zu heads have their lips more than %g mm off\n", wrong_lips[name],
                chosen.size(), kWrongLipsMm);
  }
}
