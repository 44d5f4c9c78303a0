// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/core/text.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/paint/mask_bands.h"
#include "crowdface/render/ray_scene.h"

namespace crowdface {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A point, given by coordinates along the axes of a head, in millimetres of a face of average
/// size: across (0 in the symmetry plane, positive on the head's left), up and front.
struct HeadPoint {
  double across = 0, up = 0, front = 0;
};

/// Traces rays at a head along its axes.
class HeadRays {
 public:
  HeadRays(const Topology& topology, const Components& components, const PartList& parts,
           const Positions& positions, const FaceMarks& marks, double mm)
      : positions_(positions), marks_(marks), mm_(mm), side_(marks.axes.side()) {
    for (const Triangle& t : triangles_of(topology)) {
      const PartClass of_part = parts.classes[components.component_of_vertex[t[0]]];
      if (of_part == PartClass::kBound) continue;  // rays ignore lashes and tear lines
      triangles_.push_back(t);
      is_skin_.push_back(of_part == PartClass::kSkin);
      for (const std::uint32_t v : t) box_.extend(row3(positions, v));
    }
    quads_ = quads_of(triangles_);
    scene_.emplace(device_, points_around(positions, box_.center()), quads_);
  }

  HeadPoint head_point_of(const Eigen::Vector3d& point) const {
    return {(point.dot(side_) - marks_.symmetry_offset) / mm_, point.dot(marks_.axes.up) / mm_,
            point.dot(marks_.axes.front) / mm_};
  }

  struct Hit {
    SurfacePoint place;
    HeadPoint at;
    bool is_skin = false;
  };
  /// Returns the first surface point that a ray from the front meets. The ray is parallel to the
  /// front axis, at the coordinates `across` and `up`.
  std::optional<Hit> from_front(double across, double up) const {
    return trace(point_at({across, up, 0}), -marks_.axes.front, marks_.axes.front);
  }
  /// Returns the first surface point that a ray from the left (`left` is 1) or from the right (−1)
  /// meets. The ray is parallel to the side axis, at the coordinates `up` and `front`.
  std::optional<Hit> from_side(int left, double up, double front) const {
    const Eigen::Vector3d outwards = left * side_;
    return trace(point_at({0, up, front}), -outwards, outwards);
  }

 private:
  Eigen::Vector3d point_at(const HeadPoint& at) const {
    return (at.across * mm_ + marks_.symmetry_offset) * side_ + at.up * mm_ * marks_.axes.up +
           at.front * mm_ * marks_.axes.front;
  }
  std::optional<Hit> trace(const Eigen::Vector3d& through, const Eigen::Vector3d& direction,
                           const Eigen::Vector3d& outwards) const {
    const double ahead = box_.sizes().norm() + (box_.center() - through).dot(outwards);
    const Eigen::Vector3d origin = through + ahead * outwards - box_.center();
    const Ray ray{origin.cast<float>(), direction.cast<float>()};
    const auto found = scene_->nearest_hits(std::span(&ray, 1)).front();
    if (!found) return std::nullopt;
    Hit hit;
    const Triangle& t = triangles_[found->primitive];
    const double u = found->u, v = found->v;
    hit.place.corners = t;
    hit.place.barycentric = {1 - u - v, u, v};
    hit.place.position = point_on(positions_, t, hit.place.barycentric);
    hit.at = head_point_of(hit.place.position);
    hit.is_skin = is_skin_[found->primitive];
    return hit;
  }

  const Positions& positions_;
  const FaceMarks& marks_;
  double mm_;
  Eigen::Vector3d side_;
  std::vector<Triangle> triangles_;
  std::vector<Quad> quads_;
  std::vector<bool> is_skin_;
  Eigen::AlignedBox3d box_;
  RayDevice device_;
  std::optional<RayScene> scene_;
};

/// The search for all landmarks of one head. Lengths are millimetres of a face of average size.
class LandmarkSearch {
 public:
  LandmarkSearch(const Topology& topology, const HeadShape& head, const PartList& parts,
                 const FaceMarks& marks, const HeadRays& rays, double mm)
      : topology_(topology), head_(head), parts_(parts), marks_(marks), rays_(rays), mm_(mm) {}

  FaceLandmarks run() {
    face_middle_ = find_face_middle();
    profile();
    eyes();
    nose_wings();
    mouth_corners();
    const auto ears = find_ears(topology_, head_, marks_);
    if (ears) {
      ear_rims(*ears);
    } else {
      miss({"ear_highest_left", "ear_highest_right", "ear_lowest_left", "ear_lowest_right"},
           "no ears stand out at the sides of the head");
    }
    outline(ears);
    skull(ears);
    miss({"hairline"}, "hair, not the shape of the skin, shows the hairline");
    return std::move(found_);
  }

 private:
  using Hit = HeadRays::Hit;

  double height(double mark) const { return mark / mm_; }
  void keep(const std::string& name, const std::optional<Hit>& hit, const char* reason) {
    if (hit && hit->is_skin) {
      found_.points[name] = hit->place;
    } else {
      found_.missing_reasons[name] = reason;
    }
  }
  void miss(std::initializer_list<const char*> names, const std::string& reason) {
    for (const char* name : names) found_.missing_reasons[name] = reason;
  }
  /// Head coordinates of a landmark; nothing if the landmark was not found.
  std::optional<HeadPoint> at(const std::string& name) const {
    const auto place = found_.points.find(name);
    if (place == found_.points.end()) return std::nullopt;
    return rays_.head_point_of(place->second.position);
  }

  /// Finds the middle of nose, mouth and chin: on an asymmetric head these lie beside the symmetry
  /// plane of the whole head. Returns the lateral position about which the relief of the middle of
  /// the face is most symmetric; 0 if this position is less than 1.5 mm from the head's symmetry
  /// plane, because the relief of a symmetric face shows the middle only so exactly.
  double find_face_middle() const {
    constexpr double kMaxShift = 8, kStep = 0.5, kMinShift = 1.5;
    constexpr double kHalfWidth = 20, kColumnStep = 2, kRowStep = 3, kMaxDifference = 3;
    const double top = height(marks_.bridge_height), bottom = height(marks_.chin_height);
    const auto columns = static_cast<int>((kHalfWidth + kMaxShift) / kStep);
    std::vector<std::vector<double>> rows;  // depths at equal lateral distances; NaN: no skin
    for (double up = bottom; up <= top; up += kRowStep) {
      std::vector<double>& row = rows.emplace_back();
      for (int i = -columns; i <= columns; ++i) {
        const auto hit = rays_.from_front(i * kStep, up);
        row.push_back(hit && hit->is_skin ? hit->at.front
                                          : std::numeric_limits<double>::quiet_NaN());
      }
    }
    const auto asymmetry = [&](int shift) {
      // The differences between both sides, without their trend: a face that is turned a little, or
      // that lies on one side of a round head, is symmetric except for this trend.
      std::vector<std::array<double, 2>> differences;  // lateral distance, difference of depth
      std::array<double, 2> products = {};
      for (const std::vector<double>& row : rows) {
        for (double x = kColumnStep; x <= kHalfWidth; x += kColumnStep) {
          const auto aside = static_cast<int>(x / kStep);
          const double difference = row[static_cast<std::size_t>(columns + shift + aside)] -
                                    row[static_cast<std::size_t>(columns + shift - aside)];
          if (!(std::abs(difference) < 5 * kMaxDifference)) continue;
          differences.push_back({x, difference});
          products[0] += x * x;
          products[1] += x * difference;
        }
      }
      if (differences.size() < 50) return kNever;
      double sum = 0;
      for (const auto& [x, difference] : differences)
        sum += std::min(std::abs(difference - products[1] / products[0] * x), kMaxDifference);
      return sum / static_cast<double>(differences.size());
    };
    double least = asymmetry(0);
    if (least == kNever) return 0;
    const auto last = static_cast<int>(kMaxShift / kStep);
    int best = 0;
    for (int shift = -last; shift <= last; ++shift) {
      const double here = asymmetry(shift);
      if (here >= least) continue;
      least = here;
      best = shift;
    }
    if (std::abs(best) == last) return 0;  // no minimum within the search
    return std::abs(best * kStep) < kMinShift ? 0 : best * kStep;
  }

  /// Points of the skin that are visible from the front, in the middle of the face between two
  /// heights; the highest point comes first.
  std::vector<Hit> skin_between(double low, double high, double step = 0.2) const {
    std::vector<Hit> hits;
    for (double up = high; up >= low; up -= step) {
      const auto hit = rays_.from_front(face_middle_, up);
      if (hit && hit->is_skin) hits.push_back(*hit);
    }
    return hits;
  }
  template <class Measure>
  static std::optional<Hit> best(const std::vector<Hit>& hits, const Measure& measure) {
    if (hits.empty()) return std::nullopt;
    return *std::ranges::max_element(
        hits, {}, [&](const Hit& hit) { return static_cast<double>(measure(hit.at)); });
  }
  static double front_of(const HeadPoint& at) { return at.front; }
  static double back_of(const HeadPoint& at) { return -at.front; }
  /// Returns a function that computes the distance by which a point lies behind the line through
  /// `a` and `b`, two points of the profile.
  static auto behind(const HeadPoint& a, const HeadPoint& b) {
    return [=](const HeadPoint& p) {
      const double t = (p.up - a.up) / (b.up - a.up);
      return a.front + t * (b.front - a.front) - p.front;
    };
  }

  void profile() {
    constexpr double kAroundTip = 6, kLipBegins = 1, kLipEnds = 11, kChinAbove = 13,
                     kChinBelow = 28;
    constexpr double kBrowFrom = 5, kBrowTo = 32, kNotShown = 3;
    const char* const reason = "the profile does not show it";
    const double bridge = height(marks_.bridge_height), tip = height(marks_.tip_height),
                 mouth = height(marks_.mouth_height), chin = height(marks_.chin_height);
    keep("nose_bridge", best(skin_between(bridge - 2, bridge + 2), back_of), reason);
    keep("brow_middle", best(skin_between(bridge + kBrowFrom, bridge + kBrowTo), front_of), reason);
    const auto nose = best(skin_between(tip - kAroundTip, tip + kAroundTip), front_of);
    const auto upper = best(skin_between(mouth + kLipBegins, mouth + kLipEnds), front_of);
    const auto lower = best(skin_between(mouth - kLipEnds, mouth - kLipBegins), front_of);
    const auto front = best(skin_between(chin, chin + kChinAbove), front_of);
    keep("nose_tip", nose, reason);
    keep("lip_upper", upper, reason);
    keep("lip_lower", lower, reason);
    keep("chin", front, reason);
    if (nose && upper) {
      keep("nose_base", best(skin_between(upper->at.up, nose->at.up), behind(nose->at, upper->at)),
           reason);
    }
    if (lower && front) {
      keep("chin_crease",
           best(skin_between(front->at.up, lower->at.up), behind(lower->at, front->at)), reason);
    }
    if (upper && lower) {
      // The lowest visible point of the upper lip, seen from the front. Below this point the skin
      // recedes into the slit, or turns forward again onto the lower lip.
      std::optional<Hit> rim;
      for (const Hit& hit : skin_between(lower->at.up, upper->at.up, 0.1)) {
        if (rim && hit.at.front > rim->at.front + 0.02 && hit.at.up < mouth + kNotShown) break;
        if (rim && hit.at.front < rim->at.front - kNotShown) break;
        rim = hit;
      }
      keep("mouth_middle", rim, reason);
    }
    if (front) {
      // The lower border of the chin: the point of the profile that is farthest in one direction.
      // This direction points down, tilted forwards by 30°.
      keep("chin_lowest",
           best(skin_between(chin - kChinBelow, front->at.up),
                [](const HeadPoint& p) { return 0.5 * p.front - 0.8660254037844386 * p.up; }),
           reason);
    }
  }

  /// The opening between the lids of an eye.
  struct EyeOpening {
    std::vector<HeadPoint> points;  ///< points of the eyeball between the lids
    double radius = 0;  ///< radius of the eyeball in mm, if the face is scaled to average size
  };
  EyeOpening opening_of(const ComponentShape& ball) const {
    constexpr double kStep = 0.25, kFar = 1.2;
    EyeOpening opening;
    opening.radius = ball.radius / mm_;
    const HeadPoint centre = rays_.head_point_of(ball.centre);
    const double reach = kFar * opening.radius;
    for (double x = -reach; x <= reach; x += kStep) {
      for (double y = -reach; y <= reach; y += kStep) {
        const auto hit = rays_.from_front(centre.across + x, centre.up + y);
        if (hit && !hit->is_skin &&
            (hit->place.position - ball.centre).norm() < kFar * ball.radius) {
          opening.points.push_back(hit->at);
        }
      }
    }
    return opening;
  }
  /// Walks from a point in the direction (`across`, `up`), and returns the first point of the skin
  /// that is visible from the front.
  std::optional<Hit> skin_beside(const HeadPoint& from, double across, double up) const {
    constexpr double kStep = 0.1, kReach = 8;
    for (double way = 0; way <= kReach; way += kStep) {
      auto hit = rays_.from_front(from.across + way * across, from.up + way * up);
      if (hit && hit->is_skin) return hit;
    }
    return std::nullopt;
  }

  void eyes() {
    std::array<bool, 2> seen{};
    for (const Part& part : parts_.parts) {
      if (!part.is_eyeball) continue;
      const EyeOpening opening = opening_of(parts_.shapes[part.ball_component]);
      if (opening.points.empty()) continue;
      const bool left = rays_.head_point_of(parts_.shapes[part.ball_component].centre).across > 0;
      seen[left ? 0 : 1] = true;
      eye(opening, left);
    }
    for (const bool left : {true, false}) {
      if (seen[left ? 0 : 1]) continue;
      for (const char* name : {"eye_inner", "eye_outer", "lid_upper", "lid_lower"}) {
        found_.missing_reasons[concat(name, left ? "_left" : "_right")] =
            "no eyeball shows where the lids are";
      }
    }
  }
  void eye(const EyeOpening& opening, bool left) {
    constexpr double kHalfSlit = 0.5;
    const char* const reason = "no lid surrounds the eye";
    const std::string half = left ? "_left" : "_right";
    const double outwards = left ? 1 : -1;
    const auto by = [&](double sign) {
      return [=](const HeadPoint& p) { return sign * outwards * p.across; };
    };
    const HeadPoint outer = *std::ranges::max_element(opening.points, {}, by(1));
    const HeadPoint inner = *std::ranges::max_element(opening.points, {}, by(-1));
    keep("eye_outer" + half, skin_beside(outer, outwards, 0), reason);
    keep("eye_inner" + half, inner_corner(skin_beside(inner, -outwards, 0), -outwards), reason);
    const double between = (outer.across + inner.across) / 2;
    std::vector<HeadPoint> slit;
    for (const HeadPoint& p : opening.points) {
      if (std::abs(p.across - between) <= kHalfSlit) slit.push_back(p);
    }
    if (slit.empty()) return;
    keep("lid_upper" + half, skin_beside(*std::ranges::max_element(slit, {}, &HeadPoint::up), 0, 1),
         reason);
    keep("lid_lower" + half,
         skin_beside(*std::ranges::min_element(slit, {}, &HeadPoint::up), 0, -1), reason);
  }

  /// Finds the inner corner of the eye: follows the groove between the lids from the point at which
  /// the eyeball disappears until the groove is shallow.
  std::optional<Hit> inner_corner(std::optional<Hit> from, double across) const {
    constexpr double kStep = 0.25, kReach = 9, kWander = 0.5, kLid = 1.5, kShallow = 0.5;
    const auto front = [&](double x, double y) {
      const auto hit = rays_.from_front(x, y);
      return hit && hit->is_skin ? std::optional(hit->at.front) : std::nullopt;
    };
    double at_start = 0;
    for (double way = kStep; from && way <= kReach; way += kStep) {
      const double x = from->at.across + kStep * across, start = from->at.up;
      double deepest = 0, up = start;
      for (double y = start - kWander; y <= start + kWander; y += 0.1) {
        const auto here = front(x, y), above = front(x, y + kLid), below = front(x, y - kLid);
        if (!here || !above || !below) continue;
        const double hollow = (*above + *below) / 2 - *here;
        if (hollow > deepest) deepest = hollow, up = y;
      }
      if (at_start == 0) at_start = deepest;
      if (deepest == 0 || deepest < kShallow * at_start) break;
      from = rays_.from_front(x, up);
    }
    return from;
  }

  enum class Seen { kSkin, kAny };
  /// The front coordinate of the skin at a distance `across` from the middle of the face, averaged
  /// over the left and right sides. Nothing if another part, such as teeth, covers the skin.
  /// \param seen  kAny: the front coordinate of the foremost surface, which may be another part
  std::optional<double> depth(double across, double up, Seen seen = Seen::kSkin) const {
    const auto left = rays_.from_front(face_middle_ + across, up),
               right = rays_.from_front(face_middle_ - across, up);
    if (!left || !right) return std::nullopt;
    if (seen == Seen::kSkin && !(left->is_skin && right->is_skin)) return std::nullopt;
    return (left->at.front + right->at.front) / 2;
  }
  void keep_pair(const std::string& name, double across, double up, const char* reason) {
    keep(name + "_left", rays_.from_front(face_middle_ + across, up), reason);
    keep(name + "_right", rays_.from_front(face_middle_ - across, up), reason);
  }

  /// Finds the wings of the nose: the points, between the heights of the nose's base and tip, where
  /// the steep slope from wing to cheek is farthest from the middle of the face.
  void nose_wings() {
    const char* const reason = "the nose has no wings that stand out from the cheeks";
    const auto tip = at("nose_tip"), base = at("nose_base");
    if (!tip || !base) return miss({"nose_wing_left", "nose_wing_right"}, reason);
    constexpr double kFrom = 9, kTo = 25, kStep = 0.25, kSpan = 1, kMinSlope = 0.6;
    // The cheek beside a wing of the nose is flatter than the wing. At the distance kToCheekMm
    // outward from the wing's steepest point, the slope is at most kMaxSlopeRatio times the wing's
    // steepest slope.
    constexpr double kToCheekMm = 4, kMaxSlopeRatio = 0.7;
    const auto slope = [&](double x, double up) {
      const auto inner = depth(x - kSpan, up), outer = depth(x + kSpan, up);
      return inner && outer ? (*inner - *outer) / (2 * kSpan) : 0;
    };
    // Search for the wings of the nose from the height that is the fraction kLowest of the way from
    // the base to the tip of the nose, up to kAboveTip millimetres above the tip. Lower down, the
    // fold between cheek and lip is as steep as a wing, and could be mistaken for a wing.
    constexpr double kLowest = 0.4, kAboveTip = 4;
    double widest = 0, at_height = 0;
    for (double up = base->up + kLowest * (tip->up - base->up); up <= tip->up + kAboveTip;
         up += 0.5) {
      double steepest = kMinSlope, across = 0;
      for (double x = kFrom; x <= kTo; x += kStep) {
        const double here = slope(x, up);
        if (here > steepest) steepest = here, across = x;
      }
      if (across <= widest || slope(across + kToCheekMm, up) > kMaxSlopeRatio * steepest) continue;
      widest = across;
      at_height = up;
    }
    if (widest == 0) return miss({"nose_wing_left", "nose_wing_right"}, reason);
    keep_pair("nose_wing", widest, at_height, reason);
  }

  /// Finds the corners of the mouth: follows the groove between the lips outwards until the groove
  /// is shallow.
  void mouth_corners() {
    constexpr double kFrom = 4, kTo = 42, kStep = 0.5, kWander = 1.2, kLip = 3.5;
    // The mouth ends where the groove is less deep than this fraction of its median depth.
    constexpr double kShallow = 0.3;
    const char* const reason = "no groove between the lips ends in a corner";
    const auto middle = at("mouth_middle");
    if (!middle) return miss({"mouth_left", "mouth_right"}, reason);
    std::vector<HeadPoint> groove;  // `front` holds the depth of the groove
    double up = middle->up;
    for (double x = kFrom; x <= kTo; x += kStep) {
      HeadPoint deepest{x, up, 0};
      for (double y = up - kWander; y <= up + kWander; y += 0.1) {
        const auto here = depth(x, y, Seen::kAny);
        const auto above = depth(x, y + kLip), below = depth(x, y - kLip);
        if (!here || !above || !below) continue;
        const double hollow = std::min((*above + *below) / 2 - *here, 2 * kLip);
        if (hollow > deepest.front) deepest = {x, y, hollow};
      }
      groove.push_back(deepest);
      up = deepest.up;
    }
    std::vector<double> depths;
    for (const HeadPoint& p : groove) {
      if (p.across <= 15) depths.push_back(p.front);
    }
    std::ranges::nth_element(depths,
                             depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2));
    const double enough = kShallow * depths[depths.size() / 2];
    const auto end = std::ranges::find_if(
        groove, [&](const HeadPoint& p) { return p.across > 15 && p.front < enough; });
    if (!(enough > 0) || end == groove.end()) return miss({"mouth_left", "mouth_right"}, reason);
    keep_pair("mouth", end->across, end->up, reason);
  }

  /// Finds a pair of landmarks on the outline: the points on both sides at which the head is
  /// widest.
  /// \param from, to  range of heights and of depths to search
  void widest(const std::string& name, const HeadPoint& from, const HeadPoint& to,
              const char* reason) {
    constexpr double kStep = 1;
    double most = 0;
    std::array<std::optional<Hit>, 2> best;
    for (double up = from.up; up <= to.up; up += kStep) {
      for (double front = from.front; front <= to.front; front += kStep) {
        const auto left = rays_.from_side(1, up, front), right = rays_.from_side(-1, up, front);
        if (!left || !right || left->at.across < 0 || right->at.across > 0) continue;
        const double breadth = left->at.across - right->at.across;
        if (breadth <= most) continue;
        most = breadth;
        best = {left, right};
      }
    }
    keep(name + "_left", best[0], reason);
    keep(name + "_right", best[1], reason);
  }

  void outline(const std::optional<Ears>& ears) {
    constexpr double kBeforeEar = 12, kBelowEyes = 8, kBehindEyes = 8;
    const auto outer = at("eye_outer_left");
    const auto base = at("nose_base"), mouth = at("mouth_middle"), chin = at("chin_lowest");
    const char* const reason = "the sides of the face are not there";
    if (!base || !mouth || !chin) {
      return miss({"cheek_left", "cheek_right", "jaw_left", "jaw_right"}, reason);
    }
    const double eyes = height(marks_.eyes_height);
    // The front coordinate at which the sides of the face end: 12 mm in front of the ears; without
    // ears, 80 mm behind the base of the nose.
    const double back = ears ? ears->front / mm_ + kBeforeEar : base->front - 80;
    const double front = outer ? outer->front - kBehindEyes : base->front - 30;
    widest("cheek", {0, base->up, back}, {0, eyes - kBelowEyes, front}, reason);
    // The angle of the jaw (gonion) lies at about the height of the mouth.
    widest("jaw", {0, mouth->up - 4, back - 16}, {0, mouth->up, front}, reason);
  }

  /// Finds the ears' highest and lowest points. The function samples the surface with rays that
  /// come from the side of the head: for the highest point downwards from above the ear, for the
  /// lowest point upwards from below the ear. In each of these two directions, the first steep rise
  /// of the surface is the ear's rim.
  void ear_rims(const Ears& ears) {
    constexpr double kAround = 16, kStep = 0.5, kRise = 0.8;
    const double back = ears.back / mm_, front = ears.front / mm_;
    const double top = ears.top / mm_, bottom = ears.bottom / mm_;
    for (const bool upper : {true, false}) {
      const double start = upper ? top + kAround : bottom - kAround, way = upper ? -1 : 1;
      std::array<std::optional<Hit>, 2> best;
      for (double f = back; f <= front; f += 1) {
        std::optional<std::array<double, 2>> before;
        for (double up = start; way * (up - (top + bottom) / 2) < 0; up += way * kStep) {
          const auto left = rays_.from_side(1, up, f), right = rays_.from_side(-1, up, f);
          if (!left || !right || !left->is_skin || !right->is_skin) continue;
          const std::array here = {left->at.across, -right->at.across};
          if (before && here[0] - (*before)[0] > kRise && here[1] - (*before)[1] > kRise) {
            if (!best[0] || way * (up - best[0]->at.up) < 0) best = {left, right};
            break;
          }
          before = here;
        }
      }
      const char* const reason = "the ears have no rim that stands out";
      keep(upper ? "ear_highest_left" : "ear_lowest_left", best[0], reason);
      keep(upper ? "ear_highest_right" : "ear_lowest_right", best[1], reason);
    }
  }
  void keep_vertex(const std::string& name, std::optional<std::uint32_t> v) {
    if (!v) return miss({name.c_str()}, "no skin is there");
    found_.points[name] = {{*v, *v, *v}, {1, 0, 0}, row3(head_.positions, *v), 0};
  }

  void skull(const std::optional<Ears>& ears) {
    constexpr double kForehead = 75, kBehindEars = 40, kAboveEars = 8, kAboveEyes = 25;
    const char* const reason = "the heads have no skull";
    double top = -kNever, back = kNever;
    for (Index v = 0; v < head_.positions.rows(); ++v) {
      if (!head_.is_skin[static_cast<std::size_t>(v)]) continue;
      const HeadPoint p = rays_.head_point_of(row3(head_.positions, v));
      top = std::max(top, p.up);
      if (p.up > height(marks_.eyes_height)) back = std::min(back, p.front);
    }
    const double eyes = height(marks_.eyes_height);
    const double ear = ears ? ears->back / mm_ : 0;
    if (top < eyes + kForehead || !ears || back > ear - kBehindEars) {
      return miss({"crown", "skull_back", "skull_left", "skull_right"}, reason);
    }
    std::optional<std::uint32_t> highest, farthest;
    double high = -kNever, far = -kNever;
    for (Index v = 0; v < head_.positions.rows(); ++v) {
      if (!head_.is_skin[static_cast<std::size_t>(v)]) continue;
      const HeadPoint p = rays_.head_point_of(row3(head_.positions, v));
      if (std::abs(p.across) > 6) continue;
      if (p.up > high) highest = static_cast<std::uint32_t>(v), high = p.up;
      if (p.up > eyes && -p.front > far) farthest = static_cast<std::uint32_t>(v), far = -p.front;
    }
    keep_vertex("crown", highest);
    keep_vertex("skull_back", farthest);
    const double above = std::max(ears->top / mm_ + kAboveEars, eyes + kAboveEyes);
    widest("skull", {0, above, back + 20}, {0, top - 15, ears->front / mm_ + 60}, reason);
  }

  const Topology& topology_;
  const HeadShape& head_;
  const PartList& parts_;
  const FaceMarks& marks_;
  const HeadRays& rays_;
  double mm_;
  double face_middle_ = 0;  ///< lateral position of nose, mouth and chin
  FaceLandmarks found_;
};

}  // namespace

FaceLandmarks find_face_landmarks(const Topology& topology, const Components& components,
                                  const PartList& parts, const HeadShape& head,
                                  const ReliefMatch& face) {
  const FaceMarks marks = marks_of_face(topology, head, face);
  const HeadRays rays(topology, components, parts, head.positions, marks, face.scale);
  return LandmarkSearch(topology, head, parts, marks, rays, face.scale).run();
}

FaceLandmarks find_face_landmarks(const Topology& topology, const Components& components,
                                  const PartList& parts, const Positions& positions,
                                  const HeadAxes& axes) {
  HeadShape head;
  head.positions = positions;
  for (const std::uint32_t c : components.component_of_vertex) {
    head.is_skin.push_back(parts.classes[c] == PartClass::kSkin);
  }
  for (const Part& part : parts.parts) {
    if (part.is_eyeball) head.eyeball_centres.push_back(parts.shapes[part.ball_component].centre);
  }
  const auto face = find_face(topology, head, axes);
  if (!face) return {};
  return find_face_landmarks(topology, components, parts, head, *face);
}

}  // namespace crowdface
