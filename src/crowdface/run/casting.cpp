// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/casting.h"

#include <algorithm>
#include <cmath>

#include "crowdface/cast/capacity_forecast.h"
#include "crowdface/cast/colour_draw.h"
#include "crowdface/cast/face_area.h"
#include "crowdface/cast/feasibility.h"
#include "crowdface/cast/sample_cells.h"
#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/kept_face_space.h"
#include "crowdface/heads/shared_by_heads.h"

namespace crowdface {
namespace {

std::vector<PlanePoint> lay_out(const Config& config, const Eigen::MatrixXd& head_distances) {
  const auto heads = static_cast<Index>(config.faces.names.size());
  std::vector<PlanePoint> anchors(static_cast<std::size_t>(heads), PlanePoint::Zero());
  switch (config.plane.layout) {
    case Layout::kCircle:
      anchors = circle_layout(heads);
      break;
    case Layout::kGrid:
      anchors = grid_layout(heads);
      break;
    case Layout::kSimilarity:
      anchors = similarity_layout(head_distances);
      break;
    case Layout::kManual:
      break;  // every head has an anchor of its own below
  }
  for (const auto& [head, anchor] : config.plane.anchors) {
    anchors[static_cast<std::size_t>(head)] = anchor;
  }
  return anchors;
}

/// Distances below the diagonal.
std::vector<double> below_diagonal(const Eigen::MatrixXd& distances) {
  std::vector<double> values;
  for (Index a = 0; a < distances.rows(); ++a) {
    for (Index b = 0; b < a; ++b) values.push_back(distances(a, b));
  }
  return values;
}

CrowdDistances measure(const FaceSpace& space, const Eigen::MatrixXd& head_distances,
                       const CrowdCast& cast) {
  CrowdDistances distances;
  distances.heads = quartiles(below_diagonal(head_distances));
  distances.crowd = quartiles(pair_distances(cast.points));
  if (distances.heads.median > 0) {
    distances.ratio = distances.crowd.median / distances.heads.median;
  }
  const Index regions = space.sampled().alpha.cols();
  for (Index k = 0; regions > 1 && k < regions; ++k) {
    distances.regions.push_back(quartiles(pair_distances(space, k, cast.points)));
  }
  std::vector<double> to_head, to_face;
  for (const CastFace& face : cast.crowd) {
    to_head.push_back(face.notes.nearest->head_mm);
    if (face.notes.nearest->crowd) to_face.push_back(face.notes.nearest->crowd_mm);
  }
  distances.to_nearest_head = quartiles(std::move(to_head));
  distances.to_nearest_face = quartiles(std::move(to_face));
  return distances;
}

std::vector<FamilyReport> report_families(const Config& config, const CrowdCast& cast) {
  std::vector<FamilyReport> reports;
  FacePointIndex index(cast.points.empty() ? 1 : cast.points[0].as_built.size());
  for (const FaceSpace::Point& point : cast.points) index.add(point);
  for (std::size_t f = 0; f < cast.families.size(); ++f) {
    const FamilyCast& family = cast.families[f];
    FamilyReport report;
    report.name = family.name;
    report.members = static_cast<std::uint64_t>(family.end - family.begin);
    const std::vector<FaceSpace::Point> members(cast.points.begin() + family.begin,
                                                cast.points.begin() + family.end);
    report.within = quartiles(pair_distances(members));
    std::vector<double> to_founder;
    double nearest = HUGE_VAL;
    for (const FaceSpace::Point& member : members) {
      to_founder.push_back(FaceSpace::distance(member, family.founder_point));
      nearest = std::min(nearest, index.nearest(member, nearest, 0, family.begin).mm);
      nearest = std::min(nearest, index.nearest(member, nearest, family.end, index.size()).mm);
    }
    report.to_founder = quartiles(std::move(to_founder));
    report.nearest_other_mm = nearest < HUGE_VAL ? nearest : 0;
    if (!config.families[f].parents.empty()) report.strangers_nearer = family.strangers_nearer;
    report.silhouette = silhouette(cast.families, f, cast.points);
    reports.push_back(std::move(report));
  }
  return reports;
}

std::string asked_of(const Config& config, Reason reason) {
  const DiversityOptions& diversity = config.diversity;
  switch (reason) {
    case Reason::kMinDistance:
      return concat("diversity.min_distance, ", diversity.min_distance_mm, " mm");
    case Reason::kMinDistanceToFaces:
      return concat("diversity.min_distance_to_faces, ", diversity.min_distance_to_faces_mm, " mm");
    case Reason::kRejected:
      return "a distance from the faces that reviews rejected (diversity.min_distance_to_rejected)";
    case Reason::kMaxWeight:
      return concat("diversity.max_weight, ", diversity.max_weight);
    case Reason::kImplausible:
      return concat("believability.max_deviation, ", config.believability.max_deviation);
    case Reason::kFamily:
      return "what keeps families together";
    case Reason::kGap:
    case Reason::kExposed:
    case Reason::kStretched:
    case Reason::kFlipped:
    case Reason::kIntersecting:
      break;
  }
  return concat("believability.", name_of(reason));
}

/// Tells the user early, and once, that a crowd may not get full.
class ScarcityWarning {
 public:
  explicit ScarcityWarning(const Casting& casting) : casting_(casting) {}

  void face_joined(const Rejections& thrown) {
    ++cast_;
    if (foreseen_ || casting_.diversity.mode != DiversityOptions::Mode::kFirstFit) return;
    forecast_.add(thrown.count[static_cast<std::size_t>(Reason::kMinDistance)],
                  static_cast<std::uint64_t>(casting_.diversity.candidates_for(cast_)));
    const auto faces = forecast_.faces();
    const auto attempts = static_cast<std::uint64_t>(casting_.diversity.max_attempts);
    if (faces && *faces < static_cast<double>(casting_.count)) {
      foreseen_ = true;
      log_warning(concat("roughly ", about(*faces),
                         " faces, a third to three times as many, can be ",
                         casting_.diversity.min_distance_mm, " mm apart, not ", casting_.count,
                         ": a smaller diversity.min_distance fits more (crowdface plan --estimate "
                         "tells which)"));
    } else if (!scarce_ && thrown.total() >= attempts / 5) {
      scarce_ = true;
      log_info(concat("faces are getting scarce: number ", cast_, " of ", casting_.count, " took ",
                      thrown.total(),
                      " candidates; the crowd may need a smaller "
                      "diversity.min_distance"));
    }
  }

 private:
  /// With one digit that counts: 3,480 is about 3,000.
  static std::uint64_t about(double count) {
    const double unit = std::pow(10, std::floor(std::log10(count)));
    return static_cast<std::uint64_t>(std::round(count / unit) * unit);
  }

  const Casting& casting_;
  CapacityForecast forecast_;
  std::uint64_t cast_ = 0;
  bool foreseen_ = false;
  bool scarce_ = false;
};

/// What a user can change, most promising first.
std::vector<std::string> advice(const Config& config, const Remedy& remedy) {
  std::vector<std::string> advice;
  if (remedy.largest_mm) {
    const bool all = remedy.tried == config.crowd.count;
    advice.push_back(concat("the largest ", name_of(remedy.binding), " with which ",
                            all ? "all " : "the first ", remedy.tried, " were cast in a trial: ",
                            *remedy.largest_mm, " mm", all ? "" : "; so many more need less"));
  }
  if (remedy.binding == Reason::kMinDistance) {
    if (config.diversity.mode == DiversityOptions::Mode::kFirstFit) {
      advice.emplace_back("mode: spread fits more faces at the same distance");
    } else {
      advice.emplace_back("a larger pool");
    }
    advice.emplace_back("more heads, or regions blended apart");
    advice.emplace_back("a wider range of smoothness, or a smaller pull");
  } else if (remedy.binding == Reason::kMinDistanceToFaces ||
             remedy.binding == Reason::kMaxWeight) {
    advice.emplace_back("a larger pull or distribution: uniform, which mix more heads into a face");
    advice.emplace_back("another range of smoothness");
  } else if (remedy.binding == Reason::kRejected) {
    advice.emplace_back("a smaller min_distance_to_rejected");
  } else if (remedy.binding == Reason::kFamily) {
    advice.emplace_back(
        "another max_distance or min_distance of the family, fewer members or families");
    advice.emplace_back("more heads, so that families have more room between them");
    if (std::any_of(config.families.begin(), config.families.end(), [](const auto& family) {
          return family.age.low != 0 || family.age.high != 0;
        })) {
      advice.emplace_back("a smaller range of age");
    }
  } else {
    advice.emplace_back("extrapolation nearer to 1");
    advice.emplace_back("a larger limit under believability");
  }
  return advice;
}

[[noreturn]] void tell_shortfall(const Config& config, const Remedy& remedy,
                                 const Shortfall& shortfall) {
  const std::uint64_t thrown = shortfall.rejections.total();
  const std::uint64_t by_main =
      shortfall.rejections.count[static_cast<std::size_t>(remedy.binding)];
  std::string message = concat(config.file.string(), ": ");
  if (!shortfall.family.empty()) {
    message += concat("the family ", shortfall.family, " cannot be cast: its members cannot be ",
                      "within max_distance of a founder, min_distance apart and nearer to each ",
                      "other than to everyone else (most candidates failed by ",
                      asked_of(config, remedy.binding), ")");
  } else if (!shortfall.reviewed.empty()) {
    message += concat(shortfall.reviewed, ", which the review rejects, cannot be drawn anew: ",
                      asked_of(config, remedy.binding), ", cannot be kept");
  } else {
    message += concat(
        config.crowd.count, " faces cannot be cast: ", asked_of(config, remedy.binding),
        ", cannot be kept; reached ", shortfall.reached, " of ", config.crowd.count, " faces");
  }
  if (config.diversity.mode == DiversityOptions::Mode::kFirstFit && shortfall.family.empty()) {
    message += concat(" (for the next one ", by_main, " of ", thrown,
                      " candidates were thrown away for that)");
  }
  if (shortfall.kind >= 0) {
    const auto kind = static_cast<std::size_t>(shortfall.kind);
    message += concat("; the next one is of the group ", config.groups[kind].name);
  }
  for (const std::string& line : advice(config, remedy)) message += concat("\n  - ", line);
  throw Unsatisfiable(message);
}

/// What the plan has of each face with four decimals has no more here: whoever takes the plan tells the
/// same of it.
void round_as_planned(std::vector<CastFace>& crowd) {
  for (CastFace& face : crowd) {
    face.mother_share = rounded(face.mother_share);
    Nearest& nearest = *face.notes.nearest;
    nearest.head_mm = rounded(nearest.head_mm);
    nearest.crowd_mm = rounded(nearest.crowd_mm);
  }
}

}  // namespace

CastingSpace casting_space(const Config& config, const Inputs& inputs, const Prepared& prepared,
                           const std::filesystem::path& cache) {
  const std::vector<double> areas =
      face_areas(inputs.faces.topology, inputs.skin, inputs.mean, config.distance.area,
                 config.faces.front, inputs.distance_mask);
  const SampleCells cells = find_cells(inputs, prepared.samples);
  SampledHeads heads =
      sample_heads(inputs.faces, inputs.regions, prepared.samples, prepared.trajectories,
                   inputs.max_level, mm_per(config.faces.units));
  if (inputs.mirror != nullptr) {
    heads.image = sample_images(inputs.faces, inputs.regions, *inputs.mirror, prepared.samples,
                                prepared.traced, heads);
  }
  FaceSpace space =
      kept_face_space(cache, std::move(heads), sample_weights(cells, prepared.samples, areas),
                      band_count(config.sampling));
  ProxySkin skin(cell_triangles(inputs.faces.topology, cells), space.sampled().mean,
                 space.sampled().heads);
  return {std::move(space), std::move(skin)};
}

Casting casting_of(const Config& config, const Inputs& inputs,
                   const Eigen::MatrixXd& head_distances) {
  return {config.crowd.name,
          config.crowd.count,
          config.crowd.seed,
          lay_out(config, head_distances),
          config.region_names(),
          config.sampling,
          config.recipes,
          config.blending.normalization,
          level_scale(config, inputs),
          config.diversity,
          config.families,
          config.review.reviews,
          config.groups,
          config.faces.tags};
}

AttachmentDraw attachment_draw(const Config& config) {
  const Config::Attachments& worn = config.attachments;
  return {config.crowd.seed, {worn.items.begin(), worn.items.end()},
          worn.none,         config.faces.tags,
          worn.quotas,       config.faces.names};
}

Cast cast(const Config& config, const Inputs& inputs, const Prepared& prepared,
          const MeshDefects& defects, const std::filesystem::path& cache) {
  const CastingSpace judged_in = casting_space(config, inputs, prepared, cache);
  const FaceSpace& space = judged_in.space;
  const Eigen::MatrixXd head_distances = space.head_distances();
  const Casting casting = casting_of(config, inputs, head_distances);
  const BelievabilityOptions& believability = config.believability;
  const FaceJudge judge(space, casting.diversity, believability, &judged_in.skin, defects);
  CrowdCast crowd;
  crowd.shortfall = hopeless_spread(casting, judge);
  if (!crowd.shortfall) {
    Progress progress("casting", casting.count);
    ScarcityWarning warning(casting);
    crowd = cast_crowd(casting, judge, [&](const Rejections& thrown) {
      progress.step();
      warning.face_joined(thrown);
    });
  }
  if (crowd.shortfall) {
    constexpr std::size_t kMostTrials = 20;
    Progress progress("looking for what would help", kMostTrials);
    const Remedy remedy = find_remedy(casting, space, believability, &judged_in.skin,
                                      *crowd.shortfall, [&] { progress.step(); });
    tell_shortfall(config, remedy, *crowd.shortfall);
  }
  Cast result;
  result.distances = measure(space, head_distances, crowd);
  result.families = report_families(config, crowd);
  result.anchors = casting.anchors;
  result.crowd = std::move(crowd.crowd);
  round_as_planned(result.crowd);
  if (config.textures.colours == ColourWeights::kDrawn) {
    draw_colours({config.crowd.seed, config.faces.names, config.faces.tags, config.textures.alike},
                 result.crowd);
  }
  if (!config.attachments.items.empty()) {
    draw_attachments(attachment_draw(config), crowd.kinds, result.crowd, crowd.rejected);
  }
  for (FamilyCast& family : crowd.families) {
    const auto member = std::ranges::find(result.crowd, family.name, &CastFace::family);
    if (member != result.crowd.end()) {
      family.founder.recipe.colours = member->recipe.colours;
    }
    family.founder.id = concat(family.name, "_founder");
    family.founder.family = family.name;
    result.founders.push_back(std::move(family.founder));
  }
  // Of a million faces they take a gigabyte.
  if (config.output.contact_sheet || !config.groups.empty()) {
    result.points = std::move(crowd.points);
  }
  result.kinds = std::move(crowd.kinds);
  result.rejected = std::move(crowd.rejected);
  result.rejections = crowd.rejections;
  return result;
}

}  // namespace crowdface
