// SPDX-License-Identifier: Apache-2.0
#include "crowdface/traits/measurements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

struct LandmarkRow {
  std::string_view name, symbol, where;
  bool paired = false;
};

constexpr LandmarkRow kLandmarks[] = {
    {"crown", "v", "the highest point of the head, in the middle"},
    {"hairline", "tr", "where the hair begins, in the middle of the forehead"},
    {"brow_middle", "g", "the foremost point of the forehead between the brows, in the middle"},
    {"skull_back", "op", "the rearmost point of the head, in the middle"},
    {"nose_bridge", "n", "the deepest point between the eyes, in the middle"},
    {"nose_tip", "prn", "the foremost point of the nose"},
    {"nose_base", "sn", "where the nose's underside meets the upper lip, in the middle"},
    {"lip_upper", "ls", "the foremost point of the upper lip, in the middle"},
    {"mouth_middle", "sto", "the lower edge of the upper lip, in the middle"},
    {"lip_lower", "li", "the foremost point of the lower lip, in the middle"},
    {"chin_crease", "sl", "the deepest point between the lower lip and the chin, in the middle"},
    {"chin", "pg", "the foremost point of the chin, in the middle"},
    {"chin_lowest", "gn", "the lower border of the chin, in the middle"},
    {"skull", "eu", "the widest point of the head above the ear", true},
    {"cheek", "zy", "the widest point of the face before the ear, on the cheek bone", true},
    {"jaw", "go", "the widest point of the jaw at the height of the mouth", true},
    {"eye_inner", "en", "the inner corner of the eye", true},
    {"eye_outer", "ex", "the outer corner of the eye", true},
    {"lid_upper", "ps", "the middle of the upper lid's edge", true},
    {"lid_lower", "pi", "the middle of the lower lid's edge", true},
    {"nose_wing", "al", "the outermost point of the wing of the nose", true},
    {"mouth", "ch", "the corner of the mouth", true},
    {"ear_highest", "sa", "the highest point of the ear", true},
    {"ear_lowest", "sba", "the lowest point of the ear's lobe", true},
};

std::size_t landmark(const std::string& name) {
  const auto& all = trait_landmarks();
  const auto found = std::ranges::find(all, name, &TraitLandmark::name);
  require(found != all.end(), "a measurement needs the unknown landmark ", name);
  return static_cast<std::size_t>(found - all.begin());
}

using Kind = Measurement::Kind;

/// Fills the table of all measurements.
class TableWriter {
 public:
  /// Adds a distance. With `b`, adds the distance between the landmarks a and b on the midline of
  /// the face. Without `b`, adds the distance between the left and the right landmark of the pair
  /// a.
  void distance(std::string_view name, std::string_view symbol, const char* a, const char* b,
                std::string_view definition) {
    const std::string first = a, second = b;
    if (second.empty()) {
      add(name, symbol, Kind::kDistance, definition, {{first + "_left", first + "_right"}});
    } else {
      add(name, symbol, Kind::kDistance, definition, {{first, second}});
    }
  }
  void both(std::string_view name, std::string_view symbol, Kind kind, const char* a, const char* b,
            std::string_view definition) {
    const std::string first = a, second = b;
    add(name, symbol, kind, definition,
        {{first + "_left", second + "_left"}, {first + "_right", second + "_right"}});
  }
  void angle(std::string_view name, std::string_view symbol, const char* a, const char* b,
             const char* c, std::string_view definition) {
    add(name, symbol, Kind::kAngle, definition, {{a, b, c}});
  }
  void ratio(std::string_view name, std::string_view symbol, std::string_view dividend,
             std::string_view divisor, std::string_view definition) {
    const auto index = [&](std::string_view of) {
      const auto found = std::ranges::find(rows_, of, &Measurement::name);
      require(found != rows_.end(), "a ratio of the unknown measurement ", of);
      return static_cast<std::size_t>(found - rows_.begin());
    };
    rows_.push_back({name, symbol, Kind::kRatio, definition, {}, index(dividend), index(divisor)});
  }
  std::vector<Measurement> rows() { return std::move(rows_); }

 private:
  void add(std::string_view name, std::string_view symbol, Kind kind, std::string_view definition,
           const std::vector<std::vector<std::string>>& sides) {
    Measurement& row = rows_.emplace_back(Measurement{name, symbol, kind, definition});
    for (const auto& names : sides) {
      auto& side = row.landmark_indices_by_face_side.emplace_back();
      for (std::size_t i = 0; i < side.size(); ++i) {
        side[i] = landmark(names[std::min(i, names.size() - 1)]);
      }
    }
  }
  std::vector<Measurement> rows_;
};

std::vector<Measurement> make_table() {
  TableWriter table;
  table.distance("head_length", "g-op", "brow_middle", "skull_back", "length of the head");
  table.distance("head_breadth", "eu-eu", "skull", "", "breadth of the head above the ears");
  table.distance("head_height", "v-n", "crown", "nose_bridge", "height of the head above the eyes");
  table.distance("forehead_height", "tr-n", "hairline", "nose_bridge",
                 "height of the forehead from the hairline");
  table.distance("face_height", "n-gn", "nose_bridge", "chin_lowest",
                 "height of the face from the bridge of the nose to the chin");
  table.distance("lower_face_height", "sn-gn", "nose_base", "chin_lowest",
                 "height of the face below the nose");
  table.distance("face_width", "zy-zy", "cheek", "", "width of the face at the cheek bones");
  table.distance("jaw_width", "go-go", "jaw", "", "width of the jaw at the height of the mouth");
  table.distance("chin_height", "sl-gn", "chin_crease", "chin_lowest", "height of the chin");
  table.distance("nose_height", "n-sn", "nose_bridge", "nose_base", "height of the nose");
  table.distance("nose_length", "n-prn", "nose_bridge", "nose_tip", "length of the nose's bridge");
  table.distance("nose_width", "al-al", "nose_wing", "", "width of the nose at its wings");
  table.distance("nose_protrusion", "sn-prn", "nose_base", "nose_tip",
                 "how far the tip of the nose protrudes");
  table.angle("nasofrontal_angle", "g-n-prn", "brow_middle", "nose_bridge", "nose_tip",
              "angle between forehead and bridge of the nose");
  table.angle("nasal_tip_angle", "n-prn-sn", "nose_bridge", "nose_tip", "nose_base",
              "angle at the tip of the nose");
  table.angle("nasolabial_angle", "prn-sn-ls", "nose_tip", "nose_base", "lip_upper",
              "angle between nose and upper lip");
  table.distance("mouth_width", "ch-ch", "mouth", "", "width of the mouth");
  table.distance("philtrum_height", "sn-ls", "nose_base", "lip_upper",
                 "from the nose to the front of the upper lip");
  table.distance("upper_lip_height", "sn-sto", "nose_base", "mouth_middle",
                 "height of the whole upper lip");
  table.distance("lower_lip_height", "sto-sl", "mouth_middle", "chin_crease",
                 "height of the whole lower lip");
  table.distance("upper_vermilion_height", "ls-sto", "lip_upper", "mouth_middle",
                 "from the front of the upper lip to the slit of the mouth");
  table.distance("lower_vermilion_height", "sto-li", "mouth_middle", "lip_lower",
                 "from the slit of the mouth to the front of the lower lip");
  table.distance("intercanthal", "en-en", "eye_inner", "",
                 "distance between the inner corners of the eyes");
  table.distance("biocular", "ex-ex", "eye_outer", "",
                 "distance between the outer corners of the eyes");
  table.both("eye_width", "en-ex", Kind::kDistance, "eye_inner", "eye_outer",
             "width of the eye's opening");
  table.both("eye_height", "ps-pi", Kind::kDistance, "lid_upper", "lid_lower",
             "height of the eye's opening");
  table.both("eye_slope", "en-ex", Kind::kSlope, "eye_inner", "eye_outer",
             "how much the outer corner of the eye is higher than the inner corner");
  table.both("ear_height", "sa-sba", Kind::kDistance, "ear_highest", "ear_lowest",
             "height of the ear");
  table.ratio("cephalic_index", "eu-eu / g-op", "head_breadth", "head_length",
              "breadth of the head by its length");
  table.ratio("facial_index", "n-gn / zy-zy", "face_height", "face_width",
              "height of the face by its width");
  table.ratio("mandibular_index", "go-go / zy-zy", "jaw_width", "face_width",
              "width of the jaw by width of the face");
  table.ratio("nasal_index", "al-al / n-sn", "nose_width", "nose_height",
              "width of the nose by its height");
  table.ratio("nasal_protrusion_index", "sn-prn / al-al", "nose_protrusion", "nose_width",
              "protrusion of the nose by its width");
  table.ratio("intercanthal_index", "en-en / ex-ex", "intercanthal", "biocular",
              "distance of the inner corners of the eyes by distance of the outer corners");
  table.ratio("eye_index", "ps-pi / en-ex", "eye_height", "eye_width",
              "height of the eye's opening by its width");
  table.ratio("mouth_face_index", "ch-ch / zy-zy", "mouth_width", "face_width",
              "width of the mouth by width of the face");
  table.ratio("lower_face_index", "sn-gn / n-gn", "lower_face_height", "face_height",
              "share of the face's height below the nose");
  return table.rows();
}

double rounded_degrees(double radians) {
  constexpr double kPerDegree = 1e6;
  return std::round(radians * 180 / std::numbers::pi * kPerDegree) / kPerDegree;
}

Eigen::Vector3d unit(const Eigen::Vector3d& vector) {
  const double length = std::sqrt(vector.dot(vector));
  return length > 0 ? Eigen::Vector3d(vector / length) : vector;
}

/// Returns the angle at `apex` between the directions to a and c.
double angle_at(const Eigen::Vector3d& a, const Eigen::Vector3d& apex, const Eigen::Vector3d& c) {
  return rounded_degrees(std::acos(std::clamp(unit(a - apex).dot(unit(c - apex)), -1.0, 1.0)));
}

/// Two axes of a face: `left` along the line between the inner corners of the eyes, and `up` along
/// the nose. The axes are computed from the face's own landmarks, so that the pose of the head has
/// no effect on measurements.
struct FaceAxes {
  Eigen::Vector3d left, up;
};
FaceAxes face_axes(const Positions& landmarks) {
  static const std::array<std::size_t, 4> ends = {landmark("eye_inner_left"),
                                                  landmark("eye_inner_right"),
                                                  landmark("nose_bridge"), landmark("nose_base")};
  const Eigen::Vector3d left = unit(row3(landmarks, ends[0]) - row3(landmarks, ends[1]));
  const Eigen::Vector3d nose = row3(landmarks, ends[2]) - row3(landmarks, ends[3]);
  return {left, unit(nose - nose.dot(left) * left)};
}

double measure_side(Kind kind, const std::array<std::size_t, 3>& at, const Positions& landmarks) {
  const Eigen::Vector3d a = row3(landmarks, at[0]), b = row3(landmarks, at[1]);
  switch (kind) {
    case Kind::kAngle:
      return angle_at(a, b, row3(landmarks, at[2]));
    case Kind::kSlope: {
      const FaceAxes axes = face_axes(landmarks);
      return rounded_degrees(std::atan2((b - a).dot(axes.up), std::abs((b - a).dot(axes.left))));
    }
    case Kind::kDistance:
    case Kind::kRatio:
      break;
  }
  return std::sqrt((b - a).dot(b - a));
}

}  // namespace

const std::vector<TraitLandmark>& trait_landmarks() {
  static const std::vector<TraitLandmark> landmarks = [] {
    std::vector<TraitLandmark> all;
    for (const LandmarkRow& row : kLandmarks) {
      const std::string name(row.name);
      if (!row.paired) all.push_back({name, row.symbol, row.where});
      for (const char* side : {"_left", "_right"}) {
        if (row.paired) all.push_back({name + side, row.symbol, row.where});
      }
    }
    return all;
  }();
  return landmarks;
}

const std::vector<Measurement>& measurements() {
  static const std::vector<Measurement> table = make_table();
  return table;
}

std::optional<std::size_t> find_measurement(std::string_view name) {
  const auto& all = measurements();
  const auto found = std::ranges::find(all, name, &Measurement::name);
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

std::string_view unit_of(const Measurement& measurement) {
  switch (measurement.kind) {
    case Kind::kDistance:
      return " mm";
    case Kind::kAngle:
    case Kind::kSlope:
      return " degrees";
    case Kind::kRatio:
      break;
  }
  return "";
}

std::vector<std::size_t> landmarks_of(const Measurement& measurement) {
  std::vector<std::size_t> needed;
  if (measurement.kind == Kind::kRatio) {
    for (const std::size_t of : {measurement.dividend, measurement.divisor}) {
      const std::vector<std::size_t> part = landmarks_of(measurements()[of]);
      needed.insert(needed.end(), part.begin(), part.end());
    }
  }
  for (const auto& side : measurement.landmark_indices_by_face_side)
    needed.insert(needed.end(), side.begin(), side.end());
  if (measurement.kind == Kind::kSlope) {
    for (const char* name : {"nose_bridge", "nose_base"}) needed.push_back(landmark(name));
  }
  std::ranges::sort(needed);
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  return needed;
}

double measure(const Measurement& measurement, const Positions& landmarks) {
  if (measurement.kind == Kind::kRatio) {
    const auto& all = measurements();
    const double divisor = measure(all[measurement.divisor], landmarks);
    return divisor > 0 ? measure(all[measurement.dividend], landmarks) / divisor : 0;
  }
  double sum = 0;
  for (const auto& side : measurement.landmark_indices_by_face_side) {
    sum += measure_side(measurement.kind, side, landmarks);
  }
  return sum / static_cast<double>(measurement.landmark_indices_by_face_side.size());
}

}  // namespace crowdface
