// SPDX-License-Identifier: Apache-2.0
// Makes the figures and the table of docs/paper.md that compare faces of crowdface with faces made
// by the method of Yoon, Lewis and Rhee (2017). scripts/paper_figures.sh runs this program.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>
#include <numeric>
#include <sstream>

#include "crowdface/io/image.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/render/contact_sheet.h"
#include "crowdface/render/face_renderer.h"
#include "crowdface/render/heat_colours.h"

#include "multiscale_faces/comparison.h"
#include "multiscale_faces/multiscale_face.h"

namespace crowdface::multiscale {
namespace {

namespace fs = std::filesystem;

constexpr double kMmPerUnit = 10;  // the figures' heads are in centimetres
constexpr double kScaleMm = 6;     // end of the colour scale
// Level of the base surface: the coarsest level for which more than 99 % of the lines along the
// base surface's normals meet the face, on synthetic and ICT heads.
constexpr int kBase = 2;
const std::vector<double> kBounds = {8, 16, 32, 64, 128};  // mm

/// The heads, the front patch of the heads, and the settings for rendering them.
class Heads {
 public:
  explicit Heads(fs::path folder) : folder_(std::move(folder)), first_(read_obj(file(1))) {
    Positions sum = Positions::Zero(first_.topology.vertex_count, 3);
    int count = 0;
    for (; fs::exists(file(count + 1)); ++count) sum += read_obj(file(count + 1)).positions;
    patch_ = front_patch(first_.topology, sum / count, HeadFrame{}.up, HeadFrame{}.front);
    const PolygonMaterials materials =
        polygon_materials(first_.materials, first_.topology.face_count());
    for (const std::uint32_t material : materials.material_of_polygon) {
      surfaces_.kinds.push_back(surface_kind_of_material(materials.names[material]));
    }
  }
  const FrontPatch& patch() const { return patch_; }
  const ObjFile& first() const { return first_; }

  /// Returns the vertices of a head, #V by 3, in millimetres. Heads are numbered from 1.
  const Positions& head(int number) {
    return kept(heads_, number, [&] { return read(file(number)); });
  }
  Positions read(const fs::path& path) const { return kMmPerUnit * read_obj(path).positions; }
  const MultiscaleFace& face(int number, int base) {
    MultiscaleFace& face = kept(faces_, number, [&] {
      return multiscale_face(patch_, patch_.rows_of(head(number)), base);
    });
    if (face.base_level != base) face = with_base_level(std::move(face), base);
    return face;
  }
  /// Returns the head with this number, with its front replaced by `front`.
  Positions with_front(int number, const Positions& front) {
    Positions whole = head(number);
    for (Index i = 0; i < front.rows(); ++i) {
      whole.row(patch_.head_vertices[static_cast<std::size_t>(i)]) = front.row(i);
    }
    return whole;
  }
  Rgb8Image picture(const Positions& head, const VertexColours* colours = nullptr) const {
    const FaceRenderer renderer(first_.topology, {.size_px = 288}, surfaces_);
    const Camera camera =
        fit_camera(std::vector{&head}, {}, View::kFront, {.bottom_cut_fraction = 0.25});
    return renderer.render(head, camera, colours);
  }

 private:
  template <class Value, class Make>
  static Value& kept(std::map<int, Value>& all, int number, const Make& make) {
    const auto found = all.find(number);
    return found != all.end() ? found->second : all.emplace(number, make()).first->second;
  }
  fs::path file(int number) const { return folder_ / ("head_" + std::to_string(number) + ".obj"); }

  fs::path folder_;
  ObjFile first_;
  FrontPatch patch_;
  Surfaces surfaces_;
  std::map<int, Positions> heads_;
  std::map<int, MultiscaleFace> faces_;
};

/// A head that lends detail to a face: the weight of each level of detail, and optionally a weight
/// for each vertex.
struct Lender {
  int head;
  std::vector<double> level_weights;
  std::vector<double> vertex_weights = {};
};

/// Builds a face with the method of Yoon, Lewis and Rhee. \return the whole head, #V by 3.
Positions make_face(Heads& heads, int target, int base, const std::vector<Lender>& lenders) {
  std::vector<WeightedSource> details;
  for (const Lender& of : lenders) heads.face(of.head, base);
  for (const Lender& of : lenders) {
    details.push_back({&heads.face(of.head, base), of.level_weights, of.vertex_weights});
  }
  return heads.with_front(target, synthesize(heads.face(target, base), details));
}

std::vector<double> everywhere(int base, double weight) {
  return std::vector<double>(static_cast<std::size_t>(kLevelCount - 1 - base), weight);
}

/// The result of nearest_face.
struct FittedFace {
  Positions face;
  int base = 0;
  /// the weight w of the lender's detail at each level above `base`: base + 1, base + 2, …
  std::vector<double> lender_weight_of_level;
};
/// Finds the face by Yoon, Lewis and Rhee's method that is nearest to `ours`, a face of crowdface.
/// The search tries the base levels 0 to 3, and optimizes a weight w for each level above the base
/// level: each lender gets the weight w, and the target gets 1 − w.
/// \param regions  for each lender, the lender's weight at each vertex of the patch; or empty.
FittedFace nearest_face(Heads& heads, int target, const std::vector<int>& lenders,
                        const std::vector<std::vector<double>>& regions, const Positions& ours) {
  FittedFace best;
  double best_rms = HUGE_VAL;
  for (int base = 0; base < 4; ++base) {
    const auto face_of = [&](const std::vector<double>& weights) {
      std::vector<Lender> all;
      std::vector<double> of_target = weights;
      for (double& w : of_target) w = 1 - w;
      all.push_back({target, of_target});
      for (std::size_t i = 0; i < lenders.size(); ++i) {
        all.push_back({lenders[i], weights, regions.empty() ? std::vector<double>{} : regions[i]});
      }
      return make_face(heads, target, base, all);
    };
    // The face is linear in the weights, so use coordinate descent with weights between 0 and 1.
    std::vector<double> weights = everywhere(base, 0);
    const Positions start = face_of(weights);
    std::vector<Positions> slopes;
    for (std::size_t level = 0; level < weights.size(); ++level) {
      std::vector<double> one = weights;
      one[level] = 1;
      slopes.push_back(face_of(one) - start);
    }
    Positions left = ours - start;
    for (int round = 0; round < 200; ++round) {
      for (std::size_t level = 0; level < weights.size(); ++level) {
        const double step = left.cwiseProduct(slopes[level]).sum() / slopes[level].squaredNorm();
        const double next = std::clamp(weights[level] + step, 0.0, 1.0);
        left -= (next - weights[level]) * slopes[level];
        weights[level] = next;
      }
    }
    const Positions face = face_of(weights);
    const double rms =
        differences(heads.patch(), heads.patch().rows_of(ours), heads.patch().rows_of(face))
            .rms_distance;
    if (rms < best_rms) best = {face, base, weights}, best_rms = rms;
  }
  return best;
}

/// Collects the rows of the table, and the images of the current figure.
class Report {
 public:
  Report(Heads& heads, fs::path out) : heads_(heads), out_(std::move(out)) {
    table_ << "| face | settings | rms, mm | to surface | largest | hole rims | border | kept, "
              "ours (%) | "
              "kept, theirs (%) |\n|---|---|---|---|---|---|---|---|---|\n";
  }
  void add(const std::string& name, const std::string& settings, int target, int lender,
           const Positions& ours, const Positions& theirs) {
    const FrontPatch& patch = heads_.patch();
    const Positions a = patch.rows_of(ours), b = patch.rows_of(theirs),
                    before = patch.rows_of(heads_.head(target));
    const Differences d = differences(patch, a, b);
    table_ << std::fixed;
    table_.precision(2);
    table_ << "| " << name << " | " << settings << " | " << d.rms_distance << " | "
           << d.rms_distance_to_surface << " | " << d.largest_distance << " | "
           << largest_rim_distance(patch.hole_rims, a, before) << ", "
           << largest_rim_distance(patch.hole_rims, b, before) << " | "
           << largest_rim_distance({patch.border}, a, before) << ", "
           << largest_rim_distance({patch.border}, b, before) << " | " << kept(ours, lender)
           << " | " << kept(theirs, lender) << " |\n";
    const Eigen::VectorXd apart = (ours - theirs).rowwise().norm();
    const VertexColours colours = heat_colours(apart, kScaleMm);
    cells_.push_back({heads_.picture(ours), name + ", ours"});
    cells_.push_back({heads_.picture(ours, &colours), "difference"});
    cells_.push_back({heads_.picture(theirs), "Yoon et al., " + settings});
  }
  void line(const std::string& text) { below_ << text << '\n'; }
  void write(const std::string& name, int columns) {
    const Rgb8Image sheet = contact_sheet(
        cells_, {.columns = columns, .legend = HeatLegend{kScaleMm, "distance of vertices, mm"}});
    std::ofstream(out_ / (name + ".png"), std::ios::binary)
        << encode_png(sheet.width, sheet.height, 3, sheet.pixels);
    cells_.clear();
  }
  void write_table() const {
    std::ofstream(out_ / "multiscale.md") << table_.str() << '\n' << below_.str();
  }

 private:
  /// The energy that a face keeps of its lender's detail: for each wavelength band, the energy of
  /// the face in percent of the energy of the lender. A band that the lender lacks gets "-".
  std::string kept(const Positions& face, int lender) {
    const Topology& topology = heads_.first().topology;
    const std::vector<double> of_face = band_energies(topology, heads_.patch(), face, kBounds);
    const std::vector<double> of_lender =
        band_energies(topology, heads_.patch(), heads_.head(lender), kBounds);
    std::ostringstream text;
    for (std::size_t i = 0; i < of_face.size(); ++i) {
      text << (i > 0 ? ", " : "");
      if (of_lender[i] > 0) {
        text << std::lround(100 * of_face[i] / of_lender[i]);
      } else {
        text << "-";  // the mesh is too coarse for this band
      }
    }
    return text.str();
  }

  Heads& heads_;
  fs::path out_;
  std::ostringstream table_, below_;
  std::vector<SheetCell> cells_;
};

std::string level_text(const FittedFace& nearest) {
  std::ostringstream text;
  text.precision(2);
  text << "base " << nearest.base << ", weights";
  for (const double w : nearest.lender_weight_of_level) text << ' ' << w;
  return text.str();
}

void figure_12(Heads& heads, const fs::path& ours, Report& report) {
  constexpr int kTarget = 2, kLender = 1;
  for (const auto& [name, weight] :
       {std::pair("size_17_mm", 0.08), {"size_147_mm", 0.5}, {"size_234_mm", 0.92}}) {
    const Positions face = heads.read(ours / (std::string(name) + ".obj"));
    std::ostringstream settings;
    settings << 1 - weight << "/" << weight;
    report.add(name, settings.str(), kTarget, kLender, face,
               make_face(heads, kTarget, kBase,
                         {{kTarget, everywhere(kBase, 1 - weight)},
                          {kLender, everywhere(kBase, weight)}}));
    const FittedFace nearest = nearest_face(heads, kTarget, {kLender}, {}, face);
    report.line(std::string(name) + ": " + level_text(nearest));
    report.add(name, "nearest", kTarget, kLender, face, nearest.face);
  }
  report.write("fig12_multiscale", 6);
}

void figure_10(Heads& heads, const fs::path& ours, const std::string& mask, Report& report) {
  constexpr int kTarget = 5;
  const std::vector<std::string> names = {"top", "middle", "bottom"};
  const RegionWeights weights =
      region_weights(heads.first().topology, heads.first().uvs, {MaskSource(mask)}, 3, {}, names);
  const FrontPatch& patch = heads.patch();
  std::vector<std::vector<double>> regions(3);
  std::vector<bool> border;
  for (const std::uint32_t v : patch.head_vertices) {
    for (std::size_t k = 0; k < 3; ++k)
      regions[k].push_back(weights.alpha(v, static_cast<Index>(k)));
    border.push_back(weights.alpha.row(v).maxCoeff() < 0.98);
  }
  using Lenders = std::vector<int>;
  for (const auto& [name, lenders] : {std::pair("result_a", Lenders{1, 6, 3}),
                                      {"result_b", Lenders{3, 1, 6}},
                                      {"result_c", Lenders{6, 3, 1}}}) {
    const Positions face = heads.read(ours / (std::string(name) + ".obj"));
    const FittedFace nearest = nearest_face(heads, kTarget, lenders, regions, face);
    report.line(std::string(name) + ": " + level_text(nearest));
    report.add(name, "nearest", kTarget, lenders[1], face, nearest.face);
    std::vector<Positions> used = {patch.rows_of(heads.head(kTarget))};
    for (const int head : lenders) used.push_back(patch.rows_of(heads.head(head)));
    std::ostringstream creases;
    creases << name << ": largest new crease in region borders, ours "
            << largest_new_crease(patch, patch.rows_of(face), used, border) << "°, theirs "
            << largest_new_crease(patch, patch.rows_of(nearest.face), used, border) << "°";
    report.line(creases.str());
  }
  report.write("fig10_multiscale", 3);
}

/// Combines build, features and skin of three heads. Levels 0 and 1 contain wavelengths above about
/// 50 mm, level 2 wavelengths above about 25 mm.
void bands(Heads& heads, const fs::path& ours, Report& report) {
  const Positions face = heads.read(ours / "three_bands.obj");
  const Positions theirs = make_face(heads, 4, 1, {{7, {1, 0, 0, 0, 0}}, {5, {0, 1, 1, 1, 1}}});
  report.add("three_bands", "levels 2, 3 to 6", 4, 5, face, theirs);
  report.write("bands_multiscale", 3);
}

void how_exact_and_how_fast(Heads& heads, Report& report) {
  const auto seconds_of = [](const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const FrontPatch& patch = heads.patch();
  const Positions front = patch.rows_of(heads.head(2));
  MultiscaleFace face;
  Positions again;
  const double prepare = seconds_of([&] { face = multiscale_face(patch, front, kBase); });
  const double blend = seconds_of([&] {
    const WeightedSource own{&face, everywhere(kBase, 1)};
    again = synthesize(face, {&own, 1});
  });
  const Differences d = differences(patch, front, again);
  std::ostringstream text;
  text << "front: " << patch.vertex_count() << " of " << heads.head(2).rows() << " vertices, "
       << patch.hole_rims.size() << " holes. A head from its own maps: " << d.rms_distance
       << " mm rms, " << d.rms_distance_to_surface << " to the surface, " << d.largest_distance
       << " at most; normals that miss: " << 100 * face.missed_sample_fraction
       << " %. Preparing a head: " << prepare << " s, a face: " << blend << " s";
  report.line(text.str());
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 3 && arguments.size() != 4) {
    throw UsageError("usage: multiscale_figures HEADS_DIR CROWDS_DIR OUT_DIR [MASK]");
  }
  Heads heads(arguments[0]);
  const fs::path crowds = arguments[1];
  Report report(heads, arguments[2]);
  how_exact_and_how_fast(heads, report);
  figure_12(heads, crowds / "fig12_exact" / "meshes", report);
  if (arguments.size() == 4) {
    figure_10(heads, crowds / "fig10" / "meshes", arguments[3], report);
  }
  bands(heads, crowds / "bands" / "meshes", report);
  report.write_table();
  return 0;
}

}  // namespace
}  // namespace crowdface::multiscale

int main(int argc, char** argv) try {
  return crowdface::multiscale::run({argv + 1, argv + argc});
} catch (const crowdface::Error& error) {
  std::cerr << "error: " << error.what() << '\n';
  return static_cast<int>(error.code());
}
