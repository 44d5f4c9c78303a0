// SPDX-License-Identifier: Apache-2.0
// How far the marks of faces move if their heads are rotated, thinned, refined, noisy or cut: for each
// change the marks that were not found, that are off by more than 3 mm, and the largest error.
//   crowdface_measure_marks HEADS_FOLDER…
// Heads look along +z, +y is up; each folder has one topology.
#include <filesystem>
#include <iostream>
#include <map>
#include <set>

#include "crowdface/core/error.h"
#include "crowdface/io/read_mesh.h"

#include "paint/changed_heads.h"

namespace crowdface::testing {
namespace {

struct Tally {
  int count = 0, lost = 0, far = 0;
  double most = 0;
};

void measure(const std::filesystem::path& folder) {
  constexpr double kFarMm = 3;
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".obj") files.insert(entry.path());
  }
  std::map<std::string, Tally> tallies;
  Tally all;
  for (const auto& path : files) {
    const FileMesh mesh = read_mesh(path);
    HeadShape head = mean_head_shape({mesh.topology, {}, {{"", mesh.positions}}});
    if (!put_at_origin(mesh.topology, head)) {
      std::cout << path.filename().string() << ": no face\n";
      continue;
    }
    for (const MarkError& error : mark_errors(mesh.topology, head)) {
      for (Tally* tally : {&tallies[error.change + ": " + error.mark], &all}) {
        ++tally->count;
        tally->lost += !error.is_found;
        tally->far += error.mm > kFarMm;
        tally->most = std::max(tally->most, error.mm);
      }
      if (error.mm > kFarMm || !error.is_found) {
        std::cout << path.stem().string() << ", " << error.change << ", " << error.mark << ": "
                  << (error.is_found ? std::to_string(error.mm) + " mm" : "not found") << '\n';
      }
    }
  }
  const auto print = [](const std::string& name, const Tally& tally) {
    std::cout << "| " << name << " | " << tally.count << " | " << tally.lost << " | " << tally.far
              << " | " << tally.most << " |\n";
  };
  std::cout << "\n"
            << folder.string()
            << "\n| change: mark | marks | lost | over 3 mm | most, mm |\n|---|---|---|---|---|\n";
  for (const auto& [name, tally] : tallies) print(name, tally);
  print("all", all);
}

}  // namespace
}  // namespace crowdface::testing

int main(int count, char** arguments) {
  try {
    for (int i = 1; i < count; ++i) crowdface::testing::measure(arguments[i]);
  } catch (const crowdface::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
