// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/skin_paint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/interpolate_knots.h"
#include "crowdface/core/smooth_step.h"
#include "head_models/synth/sculpture.h"
#include "head_models/synth/skin_surface.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFinest = 0.02;  // edge length in cm at which no fold or line is left out

/// Returns 1 at the centre of an ellipse in the front view, falling to 0 at its edge. The ellipse
/// is mirrored at x = 0.
double patch(const Vector3d& p, const Vector2d& centre, const Vector2d& radii) {
  const Vector2d from = (Vector2d(std::abs(p.x()), p.y()) - centre).cwiseQuotient(radii);
  const double q = 1 - from.squaredNorm();
  return q > 0 ? q * q * smooth_step(0, 2, p.z()) : 0;
}

void tint(ScreenColour& colour, const ScreenColour& factor, double amount) {
  colour *= 1 + amount * (factor - 1);
}

void cover(ScreenColour& colour, const ScreenColour& with, double amount) {
  colour += amount * (with - colour);
}

/// Returns how far the upper lip reaches above `lip_line`, cm. \param x  distance from the middle of
/// the face, cm.
double upper_lip(double x) {
  const double t = std::min(1.0, x / kMouthHalfWidth);
  return 0.86 * (1 - t * t) * (1 - 0.10 * smooth_step(0.25, 0, t));  // Cupid's bow
}
/// Returns how far the lower lip reaches below `lip_line`, cm. \param x  distance from the middle of
/// the face, cm.
double lower_lip(double x) {
  const double t = std::min(1.0, x / kMouthHalfWidth);
  return 0.98 * (1 - t * t * (0.35 + 0.65 * t));
}

/// Returns 1 on the lips, 0 outside, with a transition of about 2.8 mm.
/// \param thinner  how much narrower the lips are than average lips at each border, cm.
double on_lips(const Vector3d& p, double thinner) {
  const double x = std::abs(p.x());
  if (p.z() < 6 || x > kMouthHalfWidth) return 0;
  const double up = p.y() - lip_line(x);
  const double beyond = up > 0 ? up - upper_lip(x) : -up - lower_lip(x);
  return smooth_step(0.12, -0.16, beyond + thinner);
}

}  // namespace

SkinPaint::SkinPaint(std::uint64_t seed, std::uint64_t index, double scalp_hair,
                     const Complexion& complexion)
    : person_(random_person(seed, index)),
      complexion_(complexion),
      relief_(Identity(seed, index), kFinest),
      mottle_(mix(seed, index, 101), 1.1),
      blotch_(mix(seed, index, 102), 0.35),
      pores_(mix(seed, index, 103), 0.06),
      freckles_(mix(seed, index, 104), 0.11),
      spots_(mix(seed, index, 105), 0.26),
      hairs_(mix(seed, index, 106), 0.045),
      tufts_(mix(seed, index, 107), 0.3),
      hairline_(mix(seed, index, 108), 0.5),
      grain_(mix(seed, index, 110), 0.03),
      flush_(mix(seed, index, 111), 1.3),
      aged_(smooth_step(36, 68, person_.age_years)),
      hair_(seed, index, scalp_hair == 1),
      scalp_hair_(scalp_hair) {}

ScreenColour SkinPaint::bare_skin_colour(const Vector& p) const {
  const bool male = person_.maleness > 0;
  ScreenColour colour = complexion_.skin;
  // Melanin and blood vary separately, at wavelengths from 3 mm to 3 cm. They vary more in old
  // people.
  const double mottle = mottle_.at(p), blotch = blotch_.at(p);
  // Leave out the finest noise at the back of the head, because hair covers most of the back and
  // this noise is slow.
  const double fine_amount = smooth_step(-3, -1, p.z());
  const double fine = fine_amount > 0 ? fine_amount * freckles_.at(p) : 0;
  const double flush = flush_.at(p);
  const double melanin = 0.55 * mottle + 0.4 * blotch + 0.22 * fine;
  tint(colour, {0.80, 0.72, 0.67},
       (male ? 0.9 : 0.7) * melanin *
           (0.12 + 0.5 * aged_ + (male ? 0.25 : 0.2) * complexion_.skin_tone));
  tint(colour, {0.80, 0.66, 0.56}, (0.10 + 0.06 * aged_) * smooth_step(0.5, 0.85, fine));
  const double blood = complexion_.redness * (1 + 0.2 * aged_);
  tint(colour, {0.99, 0.80, 0.79},
       (0.35 + 0.3 * aged_) * blood * (0.5 * flush - 0.35 * blotch + 0.25 * fine));
  // The forehead is yellower than the cheeks, and the skin around the mouth is greyer.
  const double front = smooth_step(0, 4, p.z());
  tint(colour, {1.03, 1.01, 0.94}, 0.7 * front * smooth_step(1.5, 4, p.y()));
  tint(colour, {0.95, 0.965, 0.965}, 0.8 * front * smooth_step(-4.5, -7, p.y()));
  // Add redness where the skin is thin and well supplied with blood.
  const double ears = smooth_step(6.6, 7.6, std::abs(p.x())) * smooth_step(-5, -3, p.y()) *
                      smooth_step(4, 3, p.y()) * smooth_step(2.5, 1.5, p.z());
  const double red = patch(p, {4.0, -3.0}, {4.2, 4.0}) + patch(p, {0, -3.6}, {2.3, 2.2}) +
                     0.9 * ears + 0.45 * patch(p, {0, -10.3}, {2.6, 1.9}) +
                     0.25 * patch(p, {0, 3.5}, {4, 2.5});
  const double border = 0.75 + 0.35 * flush + 0.25 * blotch + 0.2 * fine;
  tint(colour, {0.98, 0.81, 0.80}, blood * std::min(1.0, red) * std::clamp(border, 0.0, 1.3));
  // The outline of a man's face is darker than its middle, above all on dark skin.
  const double middle = smooth_step(1.3, 0.5, Vector2d(p.x() / 6, (p.y() + 1.5) / 8).norm());
  if (male) {
    tint(colour, {0.88, 0.84, 0.82}, (0.25 + 0.25 * complexion_.skin_tone) * (1 - front * middle));
  }
  // Cheeks and temples of old people are hollow, and their jowls throw shadows.
  const double hollows = patch(p, {5.2, -5.4}, {2.2, 3.4}) + patch(p, {6.4, 2.6}, {2.0, 2.6}) +
                         patch(p, {3.4, -9.6}, {1.5, 1.6});
  tint(colour, {0.80, 0.75, 0.74}, 0.9 * aged_ * std::min(1.0, hollows));
  // Old skin is pale and sallow.
  cover(colour, colour.mean() * ScreenColour(1.06, 0.98, 0.88),
        0.25 * aged_ * (1 - 0.8 * complexion_.skin_tone));
  colour *= 1 - 0.08 * aged_;
  // Darken lines and hollows, because they lie in shade.
  const double shade = (male ? 1.25 : 1.08) * (1 + 0.85 * aged_) * relief_.fold_shade(p);
  tint(colour, {0.66, 0.54, 0.50}, std::clamp(shade, 0.0, 1.0));
  return colour;
}

void SkinPaint::paint_spots(const Vector& p, ScreenColour& colour) const {
  if (complexion_.freckles > 0) {
    const double where = patch(p, {2.6, -2.6}, {5.2, 3.6}) + 0.5 * patch(p, {0, 4}, {6, 4});
    const double spot =
        where > 0 ? smooth_step(0.42, 0.8, freckles_.at(p) + 0.25 * blotch_.at(p)) : 0;
    tint(colour, {0.80, 0.68, 0.58},
         0.55 * complexion_.freckles * std::min(1.0, 1.6 * where) * spot);
  }
  if (complexion_.age_spots > 0) {
    const double where = smooth_step(2.0, 5, p.y()) + 0.9 * patch(p, {5.5, -2}, {4.5, 5});
    const double spot = where > 0 ? smooth_step(0.5, 0.8, spots_.at(p) + 0.2 * freckles_.at(p)) : 0;
    tint(colour, {0.76, 0.64, 0.55}, 0.8 * complexion_.age_spots * std::min(1.0, where) * spot);
  }
}

void SkinPaint::paint_lips(const AtlasTexel& place, ScreenColour& colour) const {
  const Vector& p = place.skin.position;
  const double amount =
      std::max(on_lips(p, 0.1 * aged_), smooth_step(0.97, 1.0, place.mouth_ring_coordinate));
  if (amount <= 0) return;
  ScreenColour lips = colour;
  const bool male = person_.maleness > 0;
  const double pale = (male ? 0.4 : 0.25 * aged_) + 0.1 * aged_;
  // The contrast between skin and lips or eyes is larger in women (Russell 2009, "A sex difference
  // in facial contrast and its exaggeration by cosmetics").
  tint(lips, {0.88, male ? 0.63 : 0.67, male ? 0.65 : 0.69}, 1 - pale);
  tint(lips, {0.90, 0.62, 0.66}, complexion_.lipstick);
  tint(lips, {male ? 0.82 : 0.92, male ? 0.8 : 0.78, male ? 0.83 : 0.82}, complexion_.skin_tone);
  // The upper lip is darker, because it faces down; so is the line between the lips.
  const double up = p.y() - lip_line(p.x());
  tint(lips, {0.87, 0.83, 0.83}, smooth_step(-0.05, 0.1, up));
  tint(lips, {0.52, 0.40, 0.40}, 0.9 * smooth_step(0.2, 0.02, std::abs(up)));
  // Creases run across the lips: noise stretched along y.
  lips *= 1 + (0.05 + 0.04 * aged_) * hairs_.at({0.5 * p.x(), 0.06 * p.y(), 0.06 * p.z()});
  cover(colour, lips, amount);
}

void SkinPaint::paint_around_eyes(const AtlasTexel& place, ScreenColour& colour) const {
  const Vector& p = place.skin.position;
  const bool male = person_.maleness > 0;
  // The skin of the eye sockets is thin and bluish, mostly below the eye and at its inner corner.
  const double socket = patch(p, {3.1, -0.2}, {2.9, 2.1}) + patch(p, {1.6, -0.4}, {1.0, 1.3});
  tint(colour, {0.88, 0.86, 0.88},
       (male ? 1.2 : 0.5 + 0.4 * aged_) * (0.35 + 0.6 * aged_) * std::min(1.0, 1.3 * socket));
  tint(colour, {0.85, 0.83, 0.87}, (0.3 + 0.9 * aged_) * patch(p, {2.8, -1.3}, {2.1, 0.95}));
  const double lids = patch(p, {3.1, 0.55}, {2.3, 1.1});
  if (!male) colour *= 1 - 0.15 * patch(p, {3.12, 0.1}, {2.2, 1.2});
  tint(colour, {0.87, 0.81, 0.79}, 0.7 * lids);
  // Darken the crease of the upper lid.
  const double beside = std::min(1.0, std::abs(std::abs(p.x()) - 3.2) / 2.3);
  const double crease = smooth_step(0.16, 0.02, std::abs(p.y() - 0.42 - 0.66 * biweight(beside)));
  tint(colour, {0.74, 0.64, 0.62}, 0.75 * crease * smooth_step(0, 0.35, lids));
  tint(colour, {0.76, 0.68, 0.70}, 0.7 * complexion_.makeup * lids);
  if (place.eye_ring_coordinate <= 0) return;
  // Lashes are painted as a line along the edge of the lid; the inner edge of the lid is red.
  const bool upper = p.y() > 0.07 * (std::abs(p.x()) - 3.12);
  const double first = upper ? 0.87 + 0.04 * hairs_.at(0.6 * p) : 0.955;
  const double lashes = smooth_step(first, first + 0.06, place.eye_ring_coordinate) *
                        smooth_step(upper ? 1.3 : 1.08, 1.03, place.eye_ring_coordinate);
  const ScreenColour hair = paints_all_hair() ? complexion_.hair : from_bytes(70, 54, 44);
  cover(colour, ScreenColour(0.52, 0.33, 0.30) * (1 - 0.45 * complexion_.skin_tone),
        0.8 * smooth_step(1.05, 1.15, place.eye_ring_coordinate));
  const ScreenColour dark = ((male ? 0.45 : 0.3) - 0.2 * complexion_.makeup) * hair + 0.02;
  cover(colour, dark,
        lashes * (upper ? (male ? 0.75 : 0.88) + 0.12 * complexion_.makeup
                        : 0.3 + 0.4 * complexion_.makeup));
}

void SkinPaint::paint_openings(const AtlasTexel& place, ScreenColour& colour) const {
  cover(colour, ScreenColour(0.24, 0.10, 0.10),
        smooth_step(1.02, 1.5, place.mouth_ring_coordinate));
  cover(colour, ScreenColour(0.22, 0.09, 0.07),
        smooth_step(0.98, 1.35, place.nostril_ring_coordinate));
}

double SkinPaint::brow_coverage(const Vector& p) const {
  if (p.z() < 3) return 0;
  // A brow is an arch above the eye. The brow is thickest towards the nose.
  const double x = std::abs(p.x()), t = (x - 1.15) / 4.3;
  if (t < -0.15 || t > 1.2) return 0;
  const double arch = 1.95 + 1.45 * t * (1 - t) * (0.8 + 0.6 * t) - 0.12 * t * t +
                      complexion_.brow_arch * (0.7 + 1.7 * t * t * (1 - t));
  if (std::abs(p.y() - arch) > 1) return 0;
  return brow_hairs({x - 1.15, p.y() - arch}, p.x() > 0 ? 1 : 2);
}

/// Returns the fraction of the skin that single hairs of a brow hide.
/// \param place  point in cm: x from the brow's inner end away from the nose, y up from the brow's
///               middle line.
/// \param side   selects the hairs of the left or of the right brow.
double SkinPaint::brow_hairs(const Vector2d& place, std::uint64_t side) const {
  constexpr double kLength = 4.3, kCell = 0.08, kHair = 0.5;  // cm
  // Density of the hair roots at a place of the brow. The density decreases towards both ends of
  // the brow, and towards its upper and lower border.
  const auto density = [&](const Vector2d& root) {
    const double t = root.x() / kLength, half = complexion_.brow_width * (0.30 - 0.14 * t * t);
    const double ends = smooth_step(-0.08, 0.2, t) * smooth_step(1.06, 0.6, t);
    return complexion_.brow_density * ends * smooth_step(1.1, 0.3, std::abs(root.y()) / half);
  };
  double bare = 1 - 0.4 * density(place);
  const int column = static_cast<int>(std::floor(place.x() / kCell));
  const int row = static_cast<int>(std::floor(place.y() / kCell));
  for (int i = column - 8; i <= column + 1; ++i) {
    for (int j = row - 6; j <= row + 4; ++j) {
      // Each cell of the grid has at most one hair. The 64 bits hold four random numbers: the
      // position of the root (two), the length, and whether the hair grows.
      const std::uint64_t bits =
          mix(side, static_cast<std::uint64_t>(i + 1000), static_cast<std::uint64_t>(j + 1000));
      const auto unit = [&](int n) {
        return static_cast<double>((bits >> (16 * n)) & 0xFFFFU) / 0x1p16;
      };
      const Vector2d root = kCell * Vector2d(i + unit(0), j + unit(1));
      const double grown = density(root);
      if (unit(3) >= grown) continue;
      // At the inner end of a brow, near the nose, hairs point up. Towards the outer end, they
      // point away from the nose. All hairs lean towards the brow's middle line.
      const double t = std::clamp(root.x() / kLength, 0.0, 1.0);
      const Vector2d direction =
          Vector2d(0.35 + t, 0.9 * (1 - t) * (1 - t) + 0.15 - 1.1 * root.y()).normalized();
      const double length = kHair * (0.6 + 0.4 * unit(2)) * (0.6 + 0.4 * grown);
      const Vector2d from = place - root;
      const double along = std::clamp(from.dot(direction) / length, 0.0, 1.0);
      const double off = (from - along * length * direction).norm();
      bare *= 1 - 0.78 * (1 - 0.6 * along) * smooth_step(0.05, 0.01, off);
    }
  }
  return 1 - bare;
}

double SkinPaint::beard_coverage(const Vector& p, double strand) const {
  const double x = std::abs(p.x());
  // Upper edge of the beard, from the moustache along the cheek to the sideburn: points (|x|, y).
  static const std::array<Vector2d, 5> edge = {
      {{0, -5.0}, {2.0, -5.3}, {3.2, -6.5}, {5.2, -5.0}, {6.6, -1.2}}};
  const double over = p.y() - interpolate_knots(edge, x);
  if (over > 1.5 || p.y() < -15) return 0;
  const double wander = 0.35 * hairline_.at(p);
  const double lip = smooth_step(3.3, 2.7, x);
  const double below = smooth_step(0.6, -1.1 + 0.4 * lip, over + wander + 0.3 * strand);
  const double neck = smooth_step(-13.4, -11.4, p.y() + wander);
  const double back = smooth_step(-0.5, 0.8, p.z());
  // Beards have bare patches below the lower lip, on both sides of the chin.
  const double bare = 0.2 * patch(p, {1.3, -8.4}, {0.9, 0.55});
  return below * neck * back * (1 - on_lips(p, 0.1 * aged_)) * (1 - bare);
}

/// Returns the length of the beard at a point, in the units of Complexion::beard.
double SkinPaint::beard_length(const Vector& p) const {
  const double x = std::abs(p.x());
  const double lip =
      smooth_step(3.3, 2.7, x) * smooth_step(-7.9, -7.1, p.y()) * smooth_step(6, 8, p.z());
  // A chin beard has a round outline and joins the moustache at the corners of the mouth.
  const double round = Vector2d(x / 2.9, (p.y() + 9.5) / 2.5).norm();
  const double joint = smooth_step(0.7, 0.25, std::abs(x - 2.55)) * smooth_step(-6.2, -6.8, p.y()) *
                       smooth_step(-10.2, -9.2, p.y());
  const double chin = std::max(smooth_step(1, 0.7, round) * smooth_step(-7.4, -8.0, p.y()), joint);
  double length = complexion_.beard;
  length += lip * (complexion_.moustache - length);
  return length + chin * (complexion_.chin_beard - length);
}

double SkinPaint::beard_coverage(const Vector& p) const {
  if (p.z() < -0.5 || p.y() > 0) return 0;
  const double strand = hairs_.at({p.x(), 0.3 * p.y(), p.z()});
  const double dense = beard_coverage(p, strand) * beard_length(p);
  if (dense <= 0) return 0;
  // Single hairs are where the noise exceeds a threshold. Stubble is finer than a long beard.
  const double stubble = smooth_step(0.9, 0.5, beard_length(p));
  const double hairs = 0.5 + 0.5 * (strand + stubble * (grain_.at(p) - strand));
  const double grown = 0.75 * dense + 0.4 * smooth_step(0.7, 1, dense);
  const double hair = smooth_step(-0.1, 0.15, hairs - 1 + grown);
  return smooth_step(0.05, 0.4, dense) * std::max(hair * (1 - 0.3 * stubble), 0.5 * dense);
}

void SkinPaint::paint_beard(const Vector& p, ScreenColour& colour) const {
  if (complexion_.beard <= 0 || p.z() < -0.5 || p.y() > 0) return;
  // If beards are separate meshes, this function paints the shadow of a shaven beard on every man.
  // Otherwise, it also paints short hair: noise stretched along y.
  const double strand = paints_all_hair() ? hairs_.at({p.x(), 0.3 * p.y(), p.z()}) : 0;
  const double beard = beard_coverage(p, strand);
  if (beard <= 0) return;
  const double length = paints_all_hair() ? beard_length(p) : 0.5;
  // Hair roots below the surface give the skin a cool shade.
  tint(colour, {0.80, 0.80, 0.82}, beard * std::min(1.0, 1.4 * length));
  if (!paints_all_hair()) return;
  const double grown = smooth_step(0.3, 1.0, length);
  const double dense = grown * (0.75 + 0.10 * tufts_.at(p) + 0.30 * strand);
  cover(colour, complexion_.brow_hair * (1 + 0.25 * strand), beard * std::clamp(dense, 0.0, 0.95));
}

/// Colour of an eyeball: white with redness towards the corners, an iris of radial fibres with a
/// dark rim, a pupil. \param ball  point on the unit sphere, pupil at +z.
ScreenColour SkinPaint::eyeball_colour(const Vector& ball) const {
  const double flat = std::sqrt(ball.x() * ball.x() + ball.y() * ball.y());
  ScreenColour colour(0.70, 0.68, 0.655);
  tint(colour, {0.93, 0.80, 0.76},
       smooth_step(0.35, 0.9, flat) * (0.75 + 0.5 * blotch_.at(3 * ball)));
  tint(colour, {0.93, 0.87, 0.76}, 0.3 * complexion_.skin_tone + 0.33 * aged_);
  colour *= 1 - 0.15 * complexion_.skin_tone;
  if (ball.z() < 0) return colour;
  constexpr double kIris = 0.385, kPupil = 0.14;
  const Vector spoke = flat > 0 ? Vector(ball.x() / flat, ball.y() / flat, 0.25 * flat) : ball;
  ScreenColour iris =
      complexion_.iris * (1.05 + 0.22 * pores_.at(0.7 * spoke) + 0.12 * hairs_.at(1.6 * spoke));
  // The iris is lighter around the pupil. The lower half of the iris is also lighter, because light
  // from above reaches this half.
  iris *= 1.12 - 0.3 * smooth_step(kPupil, kIris, flat) - 0.45 * ball.y();
  iris *= 1 - 0.8 * smooth_step(kIris - 0.1, kIris, flat);
  cover(iris, ScreenColour::Constant(0.03), smooth_step(kPupil + 0.02, kPupil - 0.02, flat));
  cover(colour, iris, smooth_step(kIris + 0.03, kIris - 0.02, flat));
  // Add the shadow of the upper lid and of the upper lashes, and weaker shadows at the corners of
  // the eye and along the lower lid.
  colour *= 1 - 0.3 * smooth_step(0.4, 0.85, std::abs(ball.x()));
  colour *= 1 - 0.35 * smooth_step(-0.2, -0.4, ball.y());
  return colour * (1 - 0.78 * smooth_step(-0.06, 0.32, ball.y()));
}

ScreenColour SkinPaint::at(const AtlasTexel& place) const {
  if (place.on_eyeball > 0.5)
    return eyeball_colour(place.point_on_ball.normalized()).max(0.0).min(1.0);
  const Vector& p = place.skin.position;
  ScreenColour colour = bare_skin_colour(p);
  paint_spots(p, colour);
  paint_around_eyes(place, colour);
  paint_lips(place, colour);
  paint_openings(place, colour);
  paint_beard(p, colour);
  const bool ear = place.skin.relief_weight < 0.5;
  if (!ear && hair_.may_cover(p)) {
    const double lock = hair_.strand_brightness(p);
    const ScreenColour hair = paints_all_hair() ? complexion_.hair : 0.45 * colour;
    cover(colour, hair * (1 + (0.24 - 0.16 * hair.mean()) * lock),
          scalp_hair_ * hair_.coverage(p, lock) * std::clamp(0.92 + 0.06 * lock, 0.0, 0.97));
  }
  if (paints_all_hair()) cover(colour, complexion_.brow_hair, brow_coverage(p));
  return colour.max(0.0).min(1.0);
}

double SkinPaint::roughness_at(const AtlasTexel& place) const {
  const Vector& p = place.skin.position;
  double hair = paints_all_hair() ? brow_coverage(p) : 0;
  if (paints_all_hair() && complexion_.beard > 0 && p.z() > -0.5 && p.y() < 0) {
    hair =
        std::max(hair, beard_length(p) * beard_coverage(p, hairs_.at({p.x(), 0.3 * p.y(), p.z()})));
  }
  if (place.skin.relief_weight >= 0.5 && hair_.may_cover(p)) {
    hair = std::max(hair, scalp_hair_ * hair_.coverage(p, hair_.strand_brightness(p)));
  }
  const double lips =
      std::max(on_lips(p, 0.1 * aged_), smooth_step(0.97, 1.0, place.mouth_ring_coordinate));
  const double uneven = place.on_eyeball > 0.5 ? 0 : 0.06 * blotch_.at(p);
  return uneven + skin_roughness(place, lips, std::clamp(hair, 0.0, 1.0), person_.scaled_age());
}

}  // namespace crowdface::synth
