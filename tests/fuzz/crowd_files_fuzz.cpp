// SPDX-License-Identifier: Apache-2.0
// What crowdface reads from a crowd's folder, beside its plan and ledger: the likeness, a shard's
// notes, and the meshes that it wrote.
#include <cstdlib>
#include <string>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/crowd/likeness_file.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/io/usda_template.h"

#include "fuzz/input_file.h"

namespace {

template <class Read>
void refuse_or(const Read& read) {
  try {
    read();
  } catch (const crowdface::Error&) {
  }
}

template <class Read>
void read_positions(const Read& read) {
  refuse_or([&] {
    if (!read().allFinite()) std::abort();
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::PlanNames names = {{"ann", "bob"}, {"all"}};
  static const std::vector<std::string> ids = {"mob_0001", "mob_0002", "mob_0003"};
  const crowdface::fuzz::InputFile file(data, size);
  refuse_or([&] {
    const auto known = crowdface::read_likeness(file.path(), names, ids);
    for (const std::size_t face : known.likeness.face_order) {
      if (face >= ids.size()) std::abort();
    }
    for (const auto& near : known.likeness.neighbours) {
      for (const auto& neighbour : near) {
        if (neighbour.face >= ids.size()) std::abort();
      }
    }
  });
  const std::string text(crowdface::fuzz::text_of(data, size));
  if (const auto notes = crowdface::parse_shard_notes(text)) crowdface::format_shard_notes(*notes);
  crowdface::parse_shard(text);
  crowdface::parse_shard_name(text);
  read_positions([&] { return crowdface::read_npy(file.path()); });
  read_positions([&] { return crowdface::read_ply_positions(file.path()); });
  for (const crowdface::Index vertices : {4, 8}) {
    read_positions([&] { return crowdface::read_glb_positions(file.path(), vertices); });
    read_positions([&] { return crowdface::read_usda_positions(file.path(), vertices); });
  }
  return 0;
}
