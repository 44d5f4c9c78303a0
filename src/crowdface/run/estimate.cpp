// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/estimate.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/spread.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/trait_reports.h"

namespace crowdface {
namespace {

constexpr std::uint64_t kSmallestPool = 5000;
constexpr std::uint64_t kLargestPool = 20000;
constexpr int kCountHalvings = 7;
/// The pool must contain at least this many candidates for each face of a crowd.
constexpr std::uint64_t kMinCandidatesPerFace = 5;

/// An estimate for one size of the crowd: how far apart the faces of such a crowd can be.
struct EstimateRow {
  std::uint64_t face_count = 0;  ///< size of the crowd
  /// smallest distance in mm between two faces if the crowd is cast in spread mode
  double distance_in_spread_mode_mm = 0;
  /// largest minimum distance in mm at which first-fit casting finds this many faces
  double distance_in_first_fit_casting_mm = 0;
};

/// Returns how many candidates of the pool, taken in order, first-fit casting keeps at this minimum
/// distance. Stops counting at `enough`.
std::uint64_t first_fit_count(const CandidatePool& pool, double mm, std::uint64_t enough) {
  NearestFaceSearch kept(pool.points[0].coordinates_with_extrapolation.size());
  for (const FaceSpace::Point& point : pool.points) {
    if (static_cast<std::uint64_t>(kept.size()) >= enough) break;
    if (kept.nearest(point, mm).face < 0) kept.add(point);
  }
  return static_cast<std::uint64_t>(kept.size());
}

/// Estimates, for crowds of several sizes, the minimum distance that the faces can keep. Uses a
/// pool of candidates, which are sampled as in casting. For spread mode, one greedy pass gives the
/// distances of all crowd sizes. For first-fit casting, tries a few distances for each crowd size.
///
/// \param counts     Crowd sizes, ascending. The result leaves out sizes below 2 and sizes that are
///                   too large for the pool.
/// \param pool_size  Number of candidates. More candidates give better estimates but take longer.
std::vector<EstimateRow> estimate_capacity(const CastingOptions& casting, const FaceJudge& judge,
                                           const std::vector<std::uint64_t>& counts,
                                           std::uint64_t pool_size) {
  // The estimate ignores the crowd's groups, because each group would need a separate pass.
  CastingOptions ungrouped = casting;
  ungrouped.groups.clear();
  const CandidatePool pool =
      sample_pool(ungrouped, judge, face_distributions(ungrouped), pool_size);
  const CrowdSoFar nobody(judge.space().dimensions());
  FarthestPoints points(pool, nobody);
  // for each n: the distance of the closest pair among the first n picks
  std::vector<double> closest;
  std::uint64_t most = 0;
  for (const std::uint64_t count : counts) {
    if (count * kMinCandidatesPerFace <= pool.faces.size()) most = std::max(most, count);
  }
  while (closest.size() < most) {
    throw_if_interrupted();
    const FarthestPoints::Pick pick = points.farthest(-1);
    if (pick.candidate < 0) break;
    if (judge.check_skin(pool.faces[static_cast<std::size_t>(pick.candidate)].recipe)) {
      points.remove(pick.candidate);
      continue;
    }
    points.pick(pick.candidate);
    closest.push_back(closest.empty() ? pick.distance_mm
                                      : std::min(closest.back(), pick.distance_mm));
  }
  // For each crowd size, find by bisection the largest distance at which first-fit casting
  // succeeds.
  std::vector<EstimateRow> rows;
  for (const std::uint64_t count : counts) {
    if (count < 2 || count > closest.size()) continue;
    EstimateRow row{count, closest[count - 1], 0};
    double works = 0, fails = 1.2 * row.distance_in_spread_mode_mm;
    for (int i = 0; i < kCountHalvings; ++i) {
      throw_if_interrupted();
      const double mm = 0.5 * (works + fails);
      (first_fit_count(pool, mm, count) >= count ? works : fails) = mm;
    }
    row.distance_in_first_fit_casting_mm = works;
    rows.push_back(row);
  }
  return rows;
}

std::vector<std::uint64_t> counts_up_to(std::uint64_t asked) {
  std::set<std::uint64_t> counts = {10, 20, 50, 100, 200, 500, 1000, 2000};
  if (asked >= 2) counts.insert(asked);
  return {counts.begin(), counts.end()};
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string format_csv(const std::vector<EstimateRow>& rows) {
  std::string csv = "faces,spread_mm,first_fit_mm\r\n";
  for (const EstimateRow& row : rows) {
    csv += concat(row.face_count, ',', format_fixed(row.distance_in_spread_mode_mm, 3), ',',
                  format_fixed(row.distance_in_first_fit_casting_mm, 3), "\r\n");
  }
  return csv;
}

/// Maps a number of faces to the x coordinate in the plot, and millimetres to the y coordinate, in
/// pixels.
class Frame {
 public:
  Frame(const std::vector<EstimateRow>& rows, std::uint64_t requested_count, double requested_mm) {
    double most = 1, high = requested_mm;
    for (const EstimateRow& row : rows) {
      most = std::max(most, static_cast<double>(row.face_count));
      high = std::max({high, row.distance_in_spread_mode_mm, row.distance_in_first_fit_casting_mm});
    }
    most = std::max(most, static_cast<double>(requested_count));
    decades_ = std::max(1.0, std::ceil(std::log10(most) - 1));
    high_mm_ = std::max(1.0, std::ceil(high));
  }
  double x(double faces) const {
    return kLeft + kWidth * std::clamp((std::log10(std::max(faces, 1.0)) - 1) / decades_, 0.0, 1.0);
  }
  double y(double mm) const { return kTop + kHeight * (1 - mm / high_mm_); }
  int decades() const { return static_cast<int>(decades_); }
  int high_mm() const { return static_cast<int>(high_mm_); }

  static constexpr double kLeft = 60, kTop = 40, kWidth = 560, kHeight = 320;

 private:
  double decades_, high_mm_;
};

std::string px(double value) {
  return format_fixed(value, 1);
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return concat("<text x=\"", px(x), "\" y=\"", px(y), "\" text-anchor=\"", anchor, "\">", text,
                "</text>\n");
}

std::string line_of(const Frame& frame, const std::vector<EstimateRow>& rows,
                    double EstimateRow::*mm, const char* colour) {
  std::string points;
  for (const EstimateRow& row : rows) {
    points +=
        concat(px(frame.x(static_cast<double>(row.face_count))), ',', px(frame.y(row.*mm)), ' ');
  }
  return concat("<polyline fill=\"none\" stroke=\"", colour, "\" stroke-width=\"2\" points=\"",
                points, "\"/>\n");
}

/// Returns a text table of the estimate with aligned columns.
std::string format_estimate(const std::vector<EstimateRow>& rows, std::uint64_t requested_count,
                            double requested_mm) {
  std::string table = "   faces   spread, mm   first fit, mm\n";
  for (const EstimateRow& row : rows) {
    table += concat(padded(concat(row.face_count), 8),
                    padded(format_fixed(row.distance_in_spread_mode_mm, 2), 13),
                    padded(format_fixed(row.distance_in_first_fit_casting_mm, 2), 16),
                    row.face_count == requested_count ? "   <- asked for" : "", '\n');
  }
  if (requested_mm > 0) table += concat("asked for: min_distance ", requested_mm, " mm\n");
  return table;
}

/// A plot as SVG: number of faces on a logarithmic x axis, minimum distance in millimetres on the y
/// axis, one line for each sampling mode (spread, first fit), and a cross at the requested values.
std::string plot_estimate(const std::vector<EstimateRow>& rows, std::uint64_t requested_count,
                          double requested_mm) {
  const Frame frame(rows, requested_count, requested_mm);
  const double bottom = Frame::kTop + Frame::kHeight, right = Frame::kLeft + Frame::kWidth;
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"660\" height=\"420\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"660\" height=\"420\" fill=\"white\"/>\n";
  const int step = std::max(1, frame.high_mm() / 8);
  for (int mm = 0; mm <= frame.high_mm(); mm += step) {
    svg += concat("<line x1=\"", px(Frame::kLeft), "\" x2=\"", px(right), "\" y1=\"",
                  px(frame.y(mm)), "\" y2=\"", px(frame.y(mm)), "\" stroke=\"#ddd\"/>\n");
    svg += text_at(Frame::kLeft - 8, frame.y(mm) + 4, "end", concat(mm));
  }
  std::uint64_t faces = 10;
  for (int decade = 0; decade <= frame.decades(); ++decade, faces *= 10) {
    const double x = frame.x(static_cast<double>(faces));
    svg += concat("<line x1=\"", px(x), "\" x2=\"", px(x), "\" y1=\"", px(Frame::kTop), "\" y2=\"",
                  px(bottom), "\" stroke=\"#ddd\"/>\n");
    svg += text_at(x, bottom + 18, "middle", concat(faces));
  }
  svg += line_of(frame, rows, &EstimateRow::distance_in_spread_mode_mm, "#1f6fb4");
  svg += line_of(frame, rows, &EstimateRow::distance_in_first_fit_casting_mm, "#d0632a");
  if (requested_mm > 0 && requested_count > 0) {
    const double x = frame.x(static_cast<double>(requested_count)), y = frame.y(requested_mm);
    svg += concat("<path d=\"M", px(x - 6), ' ', px(y - 6), 'L', px(x + 6), ' ', px(y + 6), 'M',
                  px(x - 6), ' ', px(y + 6), 'L', px(x + 6), ' ', px(y - 6),
                  "\" stroke=\"black\" stroke-width=\"2\"/>\n");
  }
  svg += text_at(Frame::kLeft + Frame::kWidth / 2, bottom + 42, "middle", "faces");
  svg += text_at(Frame::kLeft, 24, "start",
                 "closest pair, mm: <tspan fill=\"#1f6fb4\">spread</tspan>, "
                 "<tspan fill=\"#d0632a\">first fit</tspan>");
  return svg + "</svg>\n";
}

}  // namespace

std::string estimate(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
                     const std::filesystem::path& cache) {
  const Job job = load_job(config_file, overrides, cache);
  const CrowdDirectory directory = crowd_directory_of(job.config);
  // Accept a folder that holds another crowd: estimate.csv and estimate.svg overwrite none of that
  // crowd's files.
  check_crowd_directory(directory, crowd_config(job.config, directory), Replace::kForce);
  const PreparedHeads prepared = prepare(job.config, job.inputs, job.smoothing, cache);
  const CastingSpace judged_in = casting_space(job.config, job.inputs, prepared, cache);
  const CastingOptions casting =
      casting_options(job.config, job.inputs, judged_in.face_space.head_distances());
  const FaceJudge judge(judged_in.face_space, casting.diversity, *job.config.believability,
                        &judged_in.proxy_skin);
  const std::uint64_t asked = job.config.crowd.count;
  const auto rows = estimate_capacity(casting, judge, counts_up_to(asked),
                                      std::clamp(5 * asked, kSmallestPool, kLargestPool));
  const double requested_mm = job.config.diversity->min_distance_mm;
  const std::filesystem::path& folder = directory.root;
  make_directories(folder);
  write_file(folder / "estimate.csv", format_csv(rows));
  write_file(folder / "estimate.svg", plot_estimate(rows, asked, requested_mm));
  log_info(concat("plot: ", (folder / "estimate.svg").string()));
  std::string table = format_estimate(rows, asked, requested_mm);
  table += format_trait_ranges(job.config, job.inputs, prepared, casting);
  if (!job.config.groups.empty() || !job.config.families.empty()) {
    table +=
        "The estimate draws all faces with the section sampling. It ignores groups and families.\n";
  }
  return table;
}

}  // namespace crowdface
