// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/families.h"

#include <algorithm>
#include <utility>

#include "crowdface/cast/ageing.h"
#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kFounders = 12;         ///< drawn one after the other before giving up
constexpr std::uint32_t kCouples = 200;         ///< likewise, of parents who are drawn
constexpr std::uint32_t kFounderAttempts = 64;  ///< candidates for each
constexpr int kFounderCandidates = 24;
constexpr double kNearestShare = 0.4;  ///< of max_distance that members go at least
constexpr double kParentShare = 0.75;  ///< of a parent in the detail that a member tends to
/// In the large forms that a member tends to: of one parent, and of somebody else; the rest is the
/// other parent's. Without somebody else children of one couple would hardly differ.
constexpr double kLargeFormsShare = 0.65;
constexpr double kForeignShare = 0.2;
constexpr int kHalvings = 10;
constexpr double kTwinsReach = 0.5;  // mm from what they are alike to

/// A child resembles a parent if at most that share of strangers are nearer to it than the parent.
constexpr double kStrangersNearer = 0.1;
/// Half of either parent must leave room for children to differ.
constexpr double kStrangersNearerToHalf = 0.06;
constexpr double kRoomAtHalf = 0.25;  ///< of max_distance, where it does not

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

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

FamilyDraws::FamilyDraws(const Casting& casting, const FamilyOptions& family,
                         const FaceJudge& judge, const Strangers& unrelated,
                         const CrowdSoFar& crowd)
    : casting_(casting),
      family_(family),
      judge_(judge),
      unrelated_(unrelated),
      parents_(family.parents.size()),
      kin_(judge.space().dimensions()),
      strangers_(judge.space().dimensions()) {
  const auto& faces = crowd.faces();
  for (std::size_t p = 0; p < parents_.size(); ++p) {
    const Parent& parent = family.parents[p];
    if (parent.head) {
      CastFace face;
      face.recipe.target = *parent.head;
      know(p, parent.id, std::move(face), judge.space().head_point(*parent.head));
      continue;
    }
    const auto found = std::find_if(faces.begin(), faces.end(), [&](const CastFace& face) {
      return face.id == parent.id || face.id == parent_id(casting.name, parent);
    });
    if (found == faces.end()) {
      if (!parent.drawn) {
        throw InvalidInput(
            concat("family ", family.name, ": no face before it is called ", quoted(parent.id)));
      }
      to_draw_.push_back(p);
      continue;
    }
    know(p, found->id, *found, crowd.points()[static_cast<std::size_t>(found - faces.begin())]);
    if (found->family) relatives_.push_back(*found->family);
  }
  const auto is_parent = [&](const std::string& name) {
    return std::any_of(parents_.begin(), parents_.end(),
                       [&](const KnownParent& one) { return !name.empty() && one.name == name; });
  };
  for (const CastFace& face : faces) {
    if (face.family && std::any_of(face.parents.begin(), face.parents.end(), is_parent)) {
      relatives_.push_back(*face.family);
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const CastFace& face = faces[i];
    const bool relative = face.family && contains(relatives_, *face.family);
    (relative || is_parent(face.id) ? kin_ : strangers_).add(crowd.points()[i]);
  }
}

void FamilyDraws::know(std::size_t parent, std::string name, CastFace face,
                       FaceSpace::Point point) {
  take_back_age(face, casting_.sampling);  // what children inherit are no wrinkles of age
  parents_[parent] = {std::move(name), std::move(face), std::move(point)};
}

bool FamilyDraws::draw_parents(const CrowdSoFar& crowd, const Kinship& kinship,
                               std::uint32_t attempt, Rejections& rejections) {
  drawn_.clear();
  for (const std::size_t p : to_draw_) {
    const Parent& parent = family_.parents[p];
    HandRecipe open;
    open.id = parent_id(casting_.name, parent);
    FaceSearch search(
        [&](std::uint32_t draw) {
          return draw_recipe(casting_, open, {0, draw, concat("parent/", parent.id)},
                             kind_of_group(casting_, parent.group));
        },
        judge_, casting_.diversity, 1,
        attempt * static_cast<std::uint32_t>(casting_.diversity.max_attempts));
    auto found = search.settle(crowd, [&](const FaceSpace::Point& point) -> std::optional<Reason> {
      for (const FaceSearch::Found& other : drawn_) {
        if (FaceSpace::distance(point, other.point) < casting_.diversity.min_distance_mm) {
          return Reason::kMinDistance;
        }
      }
      return kinship.refuses(point);
    });
    rejections.add(search.rejections());
    if (!found) return false;
    know(p, found->face.id, found->face, found->point);
    drawn_.push_back(std::move(*found));
  }
  return true;
}

/// What a parent hands down in a region: a face its recipe's part, a head its own detail.
RegionRecipe FamilyDraws::of_parent(std::size_t parent, std::size_t region,
                                    const RegionRecipe& drawn) const {
  if (!family_.parents[parent].head) return parents_[parent].face.recipe.regions[region];
  RegionRecipe own = drawn;
  own.position.reset();
  own.weights = {{*family_.parents[parent].head, 1}};
  return own;
}

CastFace FamilyDraws::founder(std::uint32_t attempt) const {
  HandRecipe open;
  open.target = family_.target;
  open.age = Range{0, 0};
  CastFace face = draw_recipe(casting_, open, {0, attempt, concat("family/", family_.name)},
                              kind_of_group(casting_, family_.group));
  if (parents_.empty()) return face;
  if (!family_.target) {
    set_target(face.recipe, mixed_weights(target_shares(parents_[0].face.recipe),
                                          target_shares(parents_[1].face.recipe), 0.5));
    face.mother_share = 0.5;
  }
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    const RegionRecipe drawn = face.recipe.regions[k];
    const int from = family_.inherit[k];
    face.recipe.regions[k] =
        from >= 0 ? of_parent(static_cast<std::size_t>(from), k, drawn)
                  : mixed(of_parent(0, k, drawn), of_parent(1, k, drawn), 0.5, casting_.scale);
  }
  return face;
}

/// (1 − t)·from + t·to, and then the age.
CastFace FamilyDraws::towards(const CastFace& from, const Draft& draft, double t) const {
  CastFace face = draft.to;
  set_target(face.recipe,
             mixed_weights(target_shares(from.recipe), target_shares(draft.to.recipe), t));
  face.mother_share = (1 - t) * from.mother_share + t * draft.to.mother_share;
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    face.recipe.regions[k] =
        mixed(from.recipe.regions[k], draft.to.recipe.regions[k], t, casting_.scale);
  }
  apply_age(face, draft.age, casting_.sampling);
  return face;
}

/// Lets a face take after a parent in its large forms, and after one in each region.
void FamilyDraws::inherit(CastFace& face, const DrawKey& key) const {
  const auto parent_of = [&](const std::string& what) -> std::size_t {
    const std::string purpose = concat(key.who, "/inherits/", what);
    return random_unit({casting_.seed, key.index, purpose, key.attempt}) < 0.5 ? 0 : 1;
  };
  if (!family_.target) {
    const double one = kLargeFormsShare / (1 - kForeignShare);
    const double mother = parent_of("large forms") == 0 ? one : 1 - one;
    const auto of_parents = mixed_weights(target_shares(parents_[0].face.recipe),
                                          target_shares(parents_[1].face.recipe), 1 - mother);
    set_target(face.recipe, mixed_weights(of_parents, target_shares(face.recipe), kForeignShare));
    face.mother_share = mother * (1 - kForeignShare);
  }
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    const int from = family_.inherit[k];
    const std::size_t parent =
        from >= 0 ? static_cast<std::size_t>(from) : parent_of(casting_.region_names[k]);
    RegionRecipe& region = face.recipe.regions[k];
    region = mixed(region, of_parent(parent, k, region), kParentShare, casting_.scale);
    face.inherits.emplace_back(parent == 0 ? "mother" : "father");
  }
  for (const KnownParent& parent : parents_) face.parents.push_back(parent.name);
}

double FamilyDraws::reach_mm(const FamilyCast& cast) const {
  const double most = family_.max_distance_mm;
  return cast.alike_to_founder ? std::min(most, kTwinsReach) : most;
}

FamilyDraws::Draft FamilyDraws::draft(const FamilyCast& cast, int member,
                                      std::uint32_t attempt) const {
  const DrawKey key = {static_cast<std::uint64_t>(member), attempt,
                       concat("family/", family_.name)};
  HandRecipe open;
  open.id = member_id(casting_.name, family_.name, member);
  open.target = family_.target;
  if (parents_.empty()) open.target = cast.founder.recipe.target;
  open.age = Range{0, 0};
  Draft draft;
  draft.to = draw_recipe(casting_, open, key, kind_of_group(casting_, family_.group));
  draft.to.family = family_.name;
  if (!parents_.empty()) inherit(draft.to, key);
  const std::string purpose = concat(key.who, "/how");
  const auto [how_far, how_old] = random_pair({casting_.seed, key.index, purpose, attempt});
  draft.age = family_.age.low + (family_.age.high - family_.age.low) * how_old;
  draft.reach_mm = kNearestShare + (1 - kNearestShare) * how_far;  // of what may be
  draft.reach_mm *= reach_mm(cast);
  if (cast.alike_to_founder) {
    draft.to.inherits = cast.founder.inherits;
    draft.age = cast.founder.age.value_or(0);
  }
  return draft;
}

CastFace FamilyDraws::as_far_as_drawn(const FamilyCast& cast, const Draft& draft) const {
  const auto beyond = [&](const CastFace& face) {
    return FaceSpace::distance(judge_.space().point(face.recipe), cast.founder_point) >
           draft.reach_mm;
  };
  double t = 1, step = 0.5;
  for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
    const bool too_far = beyond(towards(cast.founder, draft, t));
    if (t == 1 && !too_far) break;
    t += too_far ? -step : step;
  }
  // The last step may have gone too far; the one before it not.
  CastFace face = towards(cast.founder, draft, t);
  if (t > step && beyond(face)) face = towards(cast.founder, draft, std::max(t - 2 * step, 0.0));
  return face;
}

CastFace FamilyDraws::model_of_twins(const FamilyCast& cast, std::uint32_t attempt) const {
  Draft model = draft(cast, 0, attempt);
  const double age = std::exchange(model.age, 0);
  CastFace face = as_far_as_drawn(cast, model);
  face.age = age;
  return face;
}

CastFace FamilyDraws::member(const FamilyCast& cast, int member, std::uint32_t attempt) const {
  return as_far_as_drawn(cast, draft(cast, member, attempt));
}

std::optional<Reason> FamilyDraws::refuses(const FamilyCast& cast, const FaceSpace::Point& point,
                                           const std::vector<FaceSpace::Point>& own,
                                           const Kinship& kinship) const {
  return fits(cast, point, own, kinship) ? std::nullopt : std::optional(Reason::kFamily);
}

bool FamilyDraws::fits(const FamilyCast& cast, const FaceSpace::Point& point,
                       const std::vector<FaceSpace::Point>& own, const Kinship& kinship) const {
  if (FaceSpace::distance(point, cast.founder_point) > reach_mm(cast)) return false;
  if (kinship.intrudes(point, relatives_)) return false;
  if (!takes_after_parents(cast, point)) return false;
  if (kin_.nearest(point, family_.min_distance_mm).face >= 0) return false;
  double farthest = 0;
  for (const FaceSpace::Point& relative : own) {
    const double mm = FaceSpace::distance(point, relative);
    if (mm < family_.min_distance_mm) return false;
    farthest = std::max(farthest, mm);
    // The relative, too, must stay nearer to this one than to any stranger.
    if (strangers_.nearest(relative).mm <= mm) return false;
  }
  return strangers_.nearest(point).mm > farthest;
}

/// Parents who are far apart have no child that is near both: then near half of either will do.
bool FamilyDraws::takes_after_parents(const FamilyCast& cast, const FaceSpace::Point& point) const {
  if (strangers_nearer(point) <= kStrangersNearer) return true;
  if (strangers_nearer(cast.founder_point) <= kStrangersNearerToHalf) return false;
  return std::all_of(parents_.begin(), parents_.end(), [&](const KnownParent& parent) {
    return FaceSpace::distance(point, parent.point) <=
           FaceSpace::distance(cast.founder_point, parent.point) +
               kRoomAtHalf * family_.max_distance_mm;
  });
}

double FamilyDraws::strangers_nearer(const FaceSpace::Point& point) const {
  double share = 0;
  for (const KnownParent& parent : parents_) {
    share =
        std::max(share, unrelated_.share_nearer(point, FaceSpace::distance(point, parent.point)));
  }
  return share;
}

std::string parent_id(const std::string& crowd, const Parent& parent) {
  return concat(crowd, '_', parent.id);
}

std::string member_id(const std::string& crowd, const std::string& family, int member) {
  return concat(crowd, '_', family, '_', member < 10 ? "0" : "", member);
}

namespace {

/// What a hidden face must be: believable, and no more.
DiversityOptions unseen(DiversityOptions diversity) {
  diversity.min_distance_mm = 0;
  diversity.min_distance_to_faces_mm = 0;
  diversity.max_weight = 1;
  diversity.max_attempts = kFounderAttempts;
  return diversity;
}

/// The members, each against the crowd and those before it; fewer where there is no room.
std::vector<FaceSearch::Found> draw_members(const Casting& casting, const FamilyOptions& family,
                                            const FaceJudge& judge, const FamilyDraws& draws,
                                            const FamilyCast& cast, const CrowdSoFar& crowd,
                                            const Kinship& kinship, Rejections& rejections) {
  std::vector<FaceSearch::Found> members;
  std::vector<FaceSpace::Point> own;
  while (static_cast<int>(members.size()) < family.members) {
    const int number = static_cast<int>(members.size()) + 1;
    FaceSearch search([&](std::uint32_t attempt) { return draws.member(cast, number, attempt); },
                      judge, casting.diversity, 1);
    auto member = search.settle(crowd, [&](const FaceSpace::Point& point) {
      return draws.refuses(cast, point, own, kinship);
    });
    rejections.add(search.rejections());
    if (!member) break;
    own.push_back(member->point);
    members.push_back(std::move(*member));
  }
  return members;
}

}  // namespace

std::optional<FamilyCast> cast_family(const Casting& casting, const FamilyOptions& family,
                                      const FaceJudge& judge, const Strangers& unrelated,
                                      CrowdSoFar& crowd, Kinship& kinship, Rejections& rejections) {
  FamilyDraws draws(casting, family, judge, unrelated, crowd);
  const DiversityOptions of_founder = unseen(casting.diversity);
  const bool drawn = draws.wants_parents();
  for (std::uint32_t f = 0; f < (drawn ? kCouples + kFounders : kFounders); ++f) {
    throw_if_interrupted();
    if (drawn && !draws.draw_parents(crowd, kinship, f, rejections)) return std::nullopt;
    FaceSearch founder([&](std::uint32_t attempt) { return draws.founder(attempt); }, judge,
                       of_founder, family.parents.empty() ? kFounderCandidates : 1,
                       f * kFounderAttempts);
    auto found = founder.settle(crowd);
    rejections.add(founder.rejections());
    if (!found) continue;
    const double to_half = draws.strangers_nearer(found->point);
    // Of two parents who are drawn a good match is soon found; for one who is given perhaps none.
    const double enough = kStrangersNearerToHalf * (0.5 + static_cast<double>(f) / kCouples);
    if (drawn && f < kCouples && to_half > enough) continue;
    FamilyCast cast{family.name, std::move(found->face), std::move(found->point)};
    if (family.twins) {
      FaceSearch model([&](std::uint32_t attempt) { return draws.model_of_twins(cast, attempt); },
                       judge, of_founder, 1, f * kFounderAttempts);
      auto child = model.settle(crowd, [&](const FaceSpace::Point& point) {
        const bool too_far = to_half <= kStrangersNearerToHalf &&
                             draws.strangers_nearer(point) > kStrangersNearerToHalf;
        return too_far ? std::optional(Reason::kFamily) : draws.refuses(cast, point, {}, kinship);
      });
      rejections.add(model.rejections());
      if (!child) continue;
      cast = {family.name, std::move(child->face), std::move(child->point), true};
    }
    auto members = draw_members(casting, family, judge, draws, cast, crowd, kinship, rejections);
    if (static_cast<int>(members.size()) < family.members) continue;
    for (const FaceSearch::Found& parent : draws.drawn_parents()) {
      crowd.add(parent.face, parent.point);
    }
    cast.begin = crowd.size();
    cast.end = cast.begin + family.members;
    std::vector<FaceSpace::Point> points;
    for (FaceSearch::Found& member : members) {
      points.push_back(member.point);
      crowd.add(std::move(member.face), std::move(member.point));
    }
    kinship.add(family.name, points);
    for (const FaceSpace::Point& child : points) {
      cast.strangers_nearer = std::max(cast.strangers_nearer, draws.strangers_nearer(child));
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
