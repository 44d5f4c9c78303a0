// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>
#include <tuple>
#include <vector>

#include "crowdface/cast/diversity.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/config/config.h"
#include "crowdface/core/units.h"

namespace crowdface {

/// A value of an enumeration, and the word that stands for it in a config.
template <class Value>
struct Word {
  std::string_view text;
  Value value;
};

/// The words for the values of one enumeration, in the order in which messages list them.
template <class Value>
using Words = std::vector<Word<Value>>;

/// Makes the words of an enumeration from its values; the word for a value is `name_of(value)`.
template <class Values>
auto words_by_name(const Values& values) {
  Words<typename Values::value_type> enum_words;
  for (const auto value : values) enum_words.push_back({name_of(value), value});
  return enum_words;
}

/// Returns the words of all enumerations that configs and command-line options contain: a tuple
/// with one `Words<Value>` for each enumeration `Value`. Both reading and writing use these words.
inline const auto& all_words() {
  using Kind = PositionDistribution::Kind;
  using Mode = DiversityOptions::Mode;
  using MeshChecks = BelievabilityOptions::MeshChecks;
  using Verdict = ReviewMark::Verdict;
  using AgeStep = FaceChange::AgeStep;
  // kFile has no word, because a config gives the path of the file instead
  using Reference = Config::MeshComparison::Reference;
  static const std::tuple words_of_each_enum = {
      Words<bool>{{"true", true}, {"false", false}}, words_by_name(all_mesh_formats()),
      Words<AgeStep>{{"older", AgeStep::kOlder}, {"younger", AgeStep::kYounger}},
      Words<Align>{{"check", Align::kCheck}, {"rigid", Align::kRigid}, {"none", Align::kNone}},
      Words<Boundary>{{"fixed", Boundary::kFixed}, {"free", Boundary::kFree}},
      Words<OperatorKind>{{"umbrella", OperatorKind::kUmbrella}, {"lazy", OperatorKind::kLazy}},
      Words<LevelRepresentation>{{"basis", LevelRepresentation::kBasis},
                                 {"exact", LevelRepresentation::kExact},
                                 {"cubic", LevelRepresentation::kCubic}},
      Words<Normalization>{{"partition", Normalization::kPartition},
                           {"printed", Normalization::kPrinted}},
      Words<Mirroring>{{"none", Mirroring::kNone}, {"drawn", Mirroring::kRandom}},
      Words<ContactHandling>{{"auto", ContactHandling::kAuto}, {"none", ContactHandling::kNone}},
      Words<TextureBlend>{{"auto", TextureBlend::kAuto},
                          {"target", TextureBlend::kTarget},
                          {"none", TextureBlend::kNone}},
      Words<ColourWeights>{{"recipe", ColourWeights::kRecipe}, {"drawn", ColourWeights::kSampled}},
      Words<TextureFormat>{{"png", TextureFormat::kPng},
                           {"jpeg", TextureFormat::kJpeg},
                           {"exr", TextureFormat::kExr}},
      Words<SheetTexture>{{"auto", SheetTexture::kAuto},
                          {"true", SheetTexture::kYes},
                          {"false", SheetTexture::kNo}},
      Words<AttachmentMove>{{"bend", AttachmentMove::kBend}, {"rigid", AttachmentMove::kRigid}},
      Words<Tint>{{"none", Tint::kNone},
                  {"hair", Tint::kHair},
                  {"brows", Tint::kBrows},
                  {"beard", Tint::kBeard},
                  {"lashes", Tint::kLashes}},
      Words<PartShape>{{"target", PartShape::kTarget}, {"blend", PartShape::kBlend}},
      Words<Layout>{{"circle", Layout::kCircle},
                    {"grid", Layout::kGrid},
                    {"similarity", Layout::kSimilarity},
                    {"manual", Layout::kManual}},
      Words<Kind>{{"anchored", Kind::kAnchored},
                  {"uniform", Kind::kUniform},
                  {"around", Kind::kAround},
                  {"fixed", Kind::kFixed}},
      Words<ComparedArea>{{"front", ComparedArea::kFront}, {"skin", ComparedArea::kSkin}},
      Words<Mode>{{"first_fit", Mode::kFirstFit}, {"spread", Mode::kSpread}},
      Words<MeshChecks>{{"auto", MeshChecks::kAuto},
                        {"all", MeshChecks::kAll},
                        {"none", MeshChecks::kNone},
                        {"judge", MeshChecks::kJudge}},
      Words<Verdict>{{"keep", Verdict::kKeep}, {"reject", Verdict::kReject}},
      Words<Subdivision>{{"none", Subdivision::kNone},
                         {"catmull_clark", Subdivision::kCatmullClark}},
      Words<Gallery>{{"auto", Gallery::kAuto}, {"none", Gallery::kNone}},
      Words<View>{{"front", View::kFront},
                  {"three_quarter", View::kThreeQuarter},
                  {"profile", View::kProfile},
                  {"back", View::kBack}},
      Words<SheetLabel>{{"id", SheetLabel::kId},
                        {"family", SheetLabel::kFamily},
                        {"group", SheetLabel::kGroup},
                        {"target", SheetLabel::kTarget},
                        {"nearest", SheetLabel::kNearest},
                        {"nearest_head", SheetLabel::kNearestHead},
                        {"tags", SheetLabel::kTags},
                        {"attachments", SheetLabel::kAttachments}},
      Words<SheetOrder>{{"plan", SheetOrder::kPlan},
                        {"family", SheetOrder::kFamily},
                        {"group", SheetOrder::kGroup},
                        {"likeness", SheetOrder::kLikeness}},
      Words<SheetFormat>{
          {"png", SheetFormat::kPng}, {"exr", SheetFormat::kExr}, {"pdf", SheetFormat::kPdf}},
      Words<Reference>{{"none", Reference::kNothing},
                       {"target", Reference::kTarget},
                       {"nearest", Reference::kNearest}},
      Words<SurfaceKind>{{"skin", SurfaceKind::kSkin},
                         {"eye", SurfaceKind::kEye},
                         {"iris", SurfaceKind::kIris},
                         {"teeth", SurfaceKind::kTeeth},
                         {"gums", SurfaceKind::kGums},
                         {"hidden", SurfaceKind::kHidden}},
      // for FamilyOptions::parent_of_band; `drawn`: a random parent
      Words<int>{{"mother", 0}, {"father", 1}, {"drawn", -1}}};
  return words_of_each_enum;
}

/// Returns the words of the enumeration `Value`.
template <class Value>
const Words<Value>& words_of() {
  return std::get<Words<Value>>(all_words());
}

/// Returns the word that stands for a value.
///
/// \param value  must have a word.
template <class Value>
std::string_view word_of(Value value) {
  const auto& words = words_of<Value>();
  return std::ranges::find_if(words, [&](const Word<Value>& word) { return word.value == value; })
      ->text;
}

}  // namespace crowdface
