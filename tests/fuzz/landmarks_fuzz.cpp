// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <string>

#include "crowdface/core/error.h"
#include "crowdface/pick/landmark_file.h"
#include "crowdface/pick/landmark_lists.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const crowdface::fuzz::InputFile file(data, size);
  for (const std::string& extension : crowdface::landmark_extensions()) {
    try {
      crowdface::parse_landmark_list(crowdface::fuzz::text_of(data, size), "list" + extension);
    } catch (const crowdface::Error&) {
    }
  }
  try {
    const crowdface::LandmarkFile landmarks = crowdface::read_landmarks(file.path());
    for (const auto* places : {&landmarks.template_places, &landmarks.scan_places}) {
      for (const auto& [name, place] : *places) {
        if (!place.point.allFinite()) std::abort();
      }
    }
  } catch (const crowdface::Error&) {
  }
  return 0;
}
