// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/families.h"

#include <algorithm>

#include "crowdface/cast/ageing.h"
#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kFounders = 12;         ///< drawn one after the other before giving up
constexpr std::uint32_t kFounderAttempts = 64;  ///< candidates for each
constexpr int kFounderCandidates = 24;
constexpr double kNearestShare = 0.4;  ///< of max_distance that members go at least
constexpr double kParentShare = 0.75;  ///< of a parent in what a member tends to
constexpr int kHalvings = 10;

double largest(const FaceSpace::Point& point, const std::vector<FaceSpace::Point>& others) {
  double mm = 0;
  for (const FaceSpace::Point& other : others) {
    mm = std::max(mm, FaceSpace::distance(point, other));
  }
  return mm;
}

/// (1 − t)·a + t·b of two regions' numbers.
RegionRecipe mixed(const RegionRecipe& a, const RegionRecipe& b, double t,
                   const LevelScale& scale) {
  RegionRecipe region;
  region.weights = mixed_weights(a.weights, b.weights, t);
  region.smoothness = (1 - t) * a.smoothness + t * b.smoothness;
  region.iterations = iterations_of(region.smoothness, scale);
  region.extrapolation = (1 - t) * a.extrapolation + t * b.extrapolation;
  return region;
}

}  // namespace

bool Kinship::intrudes(const FaceSpace::Point& point,
                       const std::vector<std::string>& relatives) const {
  return std::any_of(members_.begin(), members_.end(), [&](const Member& member) {
    return std::find(relatives.begin(), relatives.end(), member.family) == relatives.end() &&
           FaceSpace::distance(point, member.point) <= member.radius_mm;
  });
}

void Kinship::add(const std::string& family, const std::vector<FaceSpace::Point>& members) {
  for (const FaceSpace::Point& point : members) {
    members_.push_back({family, point, largest(point, members)});
  }
}

FamilyDraws::FamilyDraws(const Casting& casting, const FamilyOptions& family,
                         const FaceJudge& judge, const CrowdSoFar& crowd)
    : casting_(casting),
      family_(family),
      judge_(judge),
      kin_(judge.space().dimensions()),
      strangers_(judge.space().dimensions()) {
  for (const Parent& parent : family.parents) {
    if (parent.head) {
      parents_.emplace_back();
      parents_.back().recipe.target = *parent.head;
      continue;
    }
    const auto& faces = crowd.faces();
    const auto found = std::find_if(faces.begin(), faces.end(), [&](const CastFace& face) {
      return face.id == parent.id || face.id == concat(casting.name, '_', parent.id);
    });
    if (found == faces.end()) {
      throw InvalidInput(
          concat("family ", family.name, ": no face before it is called ", quoted(parent.id)));
    }
    parents_.push_back(*found);
    if (found->family) relatives_.push_back(*found->family);
  }
  for (std::size_t i = 0; i < crowd.faces().size(); ++i) {
    const CastFace& face = crowd.faces()[i];
    const bool relative = face.family && std::find(relatives_.begin(), relatives_.end(),
                                                   *face.family) != relatives_.end();
    const bool parent = std::any_of(parents_.begin(), parents_.end(), [&](const CastFace& one) {
      return !one.id.empty() && one.id == face.id;
    });
    (relative || parent ? kin_ : strangers_).add(crowd.points()[i]);
  }
}

/// What a parent hands down in a region: a face its recipe's part, a head its own detail.
RegionRecipe FamilyDraws::of_parent(std::size_t parent, std::size_t region,
                                    const RegionRecipe& drawn) const {
  if (!family_.parents[parent].head) return parents_[parent].recipe.regions[region];
  RegionRecipe own = drawn;
  own.position.reset();
  own.weights = {{*family_.parents[parent].head, 1}};
  return own;
}

CastFace FamilyDraws::founder(std::uint32_t attempt) const {
  const DrawKey key = {0, attempt, concat("family/", family_.name)};
  HandRecipe open;
  open.target = family_.target;
  open.age = Range{0, 0};
  if (!open.target && !parents_.empty()) {
    const std::string purpose = concat(key.who, "/whose");
    const double unit = random_unit({casting_.seed, 0, purpose, attempt});
    open.target = parents_[unit < 0.5 ? 0 : 1].recipe.target;
  }
  CastFace face = draw_recipe(casting_, open, key, casting_.sampling.targets);
  for (std::size_t k = 0; k < face.recipe.regions.size() && !parents_.empty(); ++k) {
    const RegionRecipe drawn = face.recipe.regions[k];
    const int from = family_.inherit[k];
    face.recipe.regions[k] =
        from >= 0 ? of_parent(static_cast<std::size_t>(from), k, drawn)
                  : mixed(of_parent(0, k, drawn), of_parent(1, k, drawn), 0.5, casting_.scale);
  }
  return face;
}

/// The founder's face moved towards another on the same target.
CastFace FamilyDraws::towards(const Recipe& from, const CastFace& to, double t, double age) const {
  CastFace face = to;
  for (std::size_t k = 0; k < from.regions.size(); ++k) {
    face.recipe.regions[k] = mixed(from.regions[k], to.recipe.regions[k], t, casting_.scale);
  }
  apply_age(face, age, casting_.sampling);
  return face;
}

CastFace FamilyDraws::member(const FamilyCast& cast, int member, std::uint32_t attempt) const {
  const DrawKey key = {static_cast<std::uint64_t>(member), attempt,
                       concat("family/", family_.name)};
  const auto unit = [&](const std::string& what) {
    const std::string purpose = concat(key.who, '/', what);
    return random_pair({casting_.seed, key.index, purpose, attempt});
  };
  HandRecipe open;
  open.id = member_id(casting_.name, family_.name, member);
  open.target = cast.founder.recipe.target;
  open.age = Range{0, 0};
  CastFace to = draw_recipe(casting_, open, key, casting_.sampling.targets);
  to.family = family_.name;
  for (std::size_t k = 0; k < to.recipe.regions.size() && !parents_.empty(); ++k) {
    const int from = family_.inherit[k];
    const auto parent = static_cast<std::size_t>(
        from >= 0 ? from : (unit(concat("inherits/", casting_.region_names[k]))[0] < 0.5 ? 0 : 1));
    to.recipe.regions[k] = mixed(to.recipe.regions[k], of_parent(parent, k, to.recipe.regions[k]),
                                 kParentShare, casting_.scale);
    to.inherits.emplace_back(parent == 0 ? "mother" : "father");
  }
  const auto [how_far, how_old] = unit("how");
  const double age = family_.age.low + (family_.age.high - family_.age.low) * how_old;
  const double reach = (kNearestShare + (1 - kNearestShare) * how_far) * family_.max_distance_mm;
  double t = 1, step = 0.5;
  for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
    const FaceSpace::Point point =
        judge_.space().point(towards(cast.founder.recipe, to, t, age).recipe);
    const bool beyond = FaceSpace::distance(point, cast.founder_point) > reach;
    if (t == 1 && !beyond) break;
    t += beyond ? -step : step;
  }
  // The last step may have gone too far; the one before it not.
  CastFace face = towards(cast.founder.recipe, to, t, age);
  if (FaceSpace::distance(judge_.space().point(face.recipe), cast.founder_point) > reach &&
      t > step) {
    face = towards(cast.founder.recipe, to, std::max(t - 2 * step, 0.0), age);
  }
  return face;
}

bool FamilyDraws::refuses(const FamilyCast& cast, const FaceSpace::Point& point,
                          const std::vector<FaceSpace::Point>& own, const Kinship& kinship) const {
  if (FaceSpace::distance(point, cast.founder_point) > family_.max_distance_mm) return true;
  if (kinship.intrudes(point, relatives_)) return true;
  if (kin_.nearest(point, family_.min_distance_mm).face >= 0) return true;
  double farthest = 0;
  for (const FaceSpace::Point& relative : own) {
    const double mm = FaceSpace::distance(point, relative);
    if (mm < family_.min_distance_mm) return true;
    farthest = std::max(farthest, mm);
    // The relative, too, must stay nearer to this one than to any stranger.
    if (strangers_.nearest(relative).mm <= mm) return true;
  }
  return strangers_.nearest(point).mm <= farthest;
}

std::string member_id(const std::string& crowd, const std::string& family, int member) {
  return concat(crowd, '_', family, '_', member < 10 ? "0" : "", member);
}

std::optional<FamilyCast> cast_family(const Casting& casting, const FamilyOptions& family,
                                      const FaceJudge& judge, CrowdSoFar& crowd, Kinship& kinship,
                                      Rejections& rejections) {
  const FamilyDraws draws(casting, family, judge, crowd);
  DiversityOptions of_founder = casting.diversity;
  of_founder.min_distance_mm = 0;  // nobody sees the founder
  of_founder.min_distance_to_faces_mm = 0;
  of_founder.max_weight = 1;
  of_founder.max_attempts = kFounderAttempts;
  for (std::uint32_t f = 0; f < kFounders; ++f) {
    throw_if_interrupted();
    FaceSearch founder([&](std::uint32_t attempt) { return draws.founder(attempt); }, judge,
                       of_founder, kFounderCandidates, f * kFounderAttempts);
    auto found = founder.settle(crowd);
    rejections.add(founder.rejections());
    if (!found) continue;
    FamilyCast cast{family.name, std::move(found->face), std::move(found->point), crowd.size(),
                    crowd.size() + family.members};
    std::vector<CastFace> members;
    std::vector<FaceSpace::Point> points;
    for (int m = 1; m <= family.members; ++m) {
      FaceSearch search([&](std::uint32_t attempt) { return draws.member(cast, m, attempt); },
                        judge, casting.diversity, 1);
      auto member = search.settle(crowd, [&](const FaceSpace::Point& point) {
        return draws.refuses(cast, point, points, kinship);
      });
      rejections.add(search.rejections());
      if (!member) break;
      members.push_back(std::move(member->face));
      points.push_back(std::move(member->point));
    }
    if (static_cast<int>(members.size()) < family.members) continue;
    kinship.add(family.name, points);
    for (std::size_t m = 0; m < members.size(); ++m) {
      crowd.add(std::move(members[m]), std::move(points[m]));
    }
    return cast;
  }
  return std::nullopt;
}

double silhouette(const std::vector<FamilyCast>& families, std::size_t family,
                  const std::vector<FaceSpace::Point>& points) {
  const FamilyCast& own = families[family];
  const auto mean_distance = [&](Index from, const std::vector<Index>& to) {
    double sum = 0;
    for (const Index other : to) {
      sum += FaceSpace::distance(points[static_cast<std::size_t>(from)],
                                 points[static_cast<std::size_t>(other)]);
    }
    return to.empty() ? 0.0 : sum / static_cast<double>(to.size());
  };
  const auto range = [](Index begin, Index end, Index without) {
    std::vector<Index> faces;
    for (Index i = begin; i < end; ++i) {
      if (i != without) faces.push_back(i);
    }
    return faces;
  };
  double sum = 0;
  for (Index i = own.begin; i < own.end; ++i) {
    const double a = mean_distance(i, range(own.begin, own.end, i));
    double b = HUGE_VAL;
    for (std::size_t f = 0; f < families.size(); ++f) {
      if (f == family || families[f].begin == families[f].end) continue;
      b = std::min(b, mean_distance(i, range(families[f].begin, families[f].end, -1)));
    }
    if (families.size() == 1) {
      std::vector<Index> others = range(0, own.begin, -1);
      const auto after = range(own.end, static_cast<Index>(points.size()), -1);
      others.insert(others.end(), after.begin(), after.end());
      if (!others.empty()) b = mean_distance(i, others);
    }
    if (b < HUGE_VAL && std::max(a, b) > 0) sum += (b - a) / std::max(a, b);
  }
  return own.end > own.begin ? sum / static_cast<double>(own.end - own.begin) : 0;
}

}  // namespace crowdface
