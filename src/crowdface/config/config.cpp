// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config.h"

#include <set>

#include "crowdface/cast/diversity.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/core/text.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

Config::Config() = default;
Config::Config(const Config&) = default;
Config::Config(Config&&) noexcept = default;
Config& Config::operator=(const Config&) = default;
Config& Config::operator=(Config&&) noexcept = default;
Config::~Config() = default;

CellSize Config::ContactSheet::plain_cell_size() const {
  return {cell * static_cast<int>(views.size()), cell, 2};
}

std::vector<std::string> Config::region_names() const {
  return regions.names.empty() ? std::vector<std::string>{"all"} : regions.names;
}

std::vector<std::string> Config::region_band_names() const {
  if (sampling->bands.empty()) return region_names();
  std::vector<std::string> of_bands;
  for (const std::string& region : region_names()) {
    for (const BandSampling& band : sampling->bands)
      of_bands.push_back(concat(region, '/', band.name));
  }
  return of_bands;
}

PlanNames Config::plan_names() const {
  PlanNames names{faces.names, region_names()};
  for (const BandSampling& band : sampling->bands) names.bands.push_back(band.name);
  for (const Attachment& item : attachments.items) names.attachments.push_back(item.name);
  for (const std::size_t trait : named_traits()) {
    names.traits.emplace_back(measurements()[trait].name);
  }
  return names;
}

std::vector<std::size_t> Config::named_traits() const {
  std::set<std::size_t> named;
  const auto add = [&](const TraitLimits& limits) {
    for (const TraitLimit& limit : limits) named.insert(limit.trait);
  };
  add(sampling->traits);
  for (const Group& group : groups) add(group.sampling.traits);
  for (const ManualRecipe& recipe : recipes) add(recipe.traits);
  for (const FamilyOptions& family : families) add(family.traits);
  for (const FaceChange& change : changes) add(change.traits);
  for (const Review& one : review.reviews) {
    for (const FaceChange& change : one.changes) add(change.traits);
  }
  for (const TraitTarget& target : population.targets) named.insert(target.trait);
  return {named.begin(), named.end()};
}

}  // namespace crowdface
