// SPDX-License-Identifier: Apache-2.0
// One face of 1.2 million vertices as a picture of 256² pixels: the whole, and its stages.
#include <benchmark/benchmark.h>

#include "crowdface/core/parallel.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/camera_space.h"
#include "crowdface/render/face_renderer.h"
#include "crowdface/render/ray_scene.h"
#include "head_models/synth/synthetic_head.h"

#include "benchmarks/bench_size.h"

namespace crowdface {
namespace {

/// A head, and the camera of a crowd.
struct Subject {
  SyntheticHeads heads{bench::size(1'200'000, 5'000)};
  Positions positions = heads.positions(1, 1);
  Positions other = heads.positions(1, 2);
  Camera camera = fit(positions);

  static Camera fit(const Positions& head) {
    const Positions* heads[] = {&head};
    return fit_camera(heads, {}, View::kFront, {.bottom_cut_fraction = 0.22});
  }
};

const Subject& subject() {
  static const Subject only;
  return only;
}

void BM_Render(benchmark::State& state) {
  const Subject& s = subject();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const FaceRenderer renderer(s.heads.topology(), {.ambient_occlusion = state.range(1) != 0}, {},
                              state.range(2) != 0 ? &s.other : nullptr);
  renderer.render(s.positions, s.camera);
  for (auto _ : state) benchmark::DoNotOptimize(renderer.render(s.positions, s.camera).pixels);
}
BENCHMARK(BM_Render)
    ->ArgNames({"threads", "occlusion", "refit"})
    ->ArgsProduct({{1, 2}, {0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void BM_CameraNormals(benchmark::State& state) {
  const Subject& s = subject();
  const NormalFans fans(s.heads.topology());
  const std::vector<float> points = to_camera_space(s.positions, s.camera);
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera_normals(s.heads.topology(), fans, points, 1).data());
  }
}
BENCHMARK(BM_CameraNormals)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

/// Building the ray tracer's tree against fitting it to other points.
void BM_Scene(benchmark::State& state) {
  const Subject& s = subject();
  const RayDevice device;
  std::vector<Quad> quads;
  for (Index f = 0; f < s.heads.topology().face_count(); ++f) {
    const auto face = s.heads.topology().face(f);
    quads.push_back({face[0], face[1], face[2], face[3]});
  }
  RayScene moving(device, to_camera_space(s.other, s.camera), quads, RayScene::Tree::kMovable);
  for (auto _ : state) {
    std::vector<float> points = to_camera_space(s.positions, s.camera);
    if (state.range(0) == 0) {
      benchmark::DoNotOptimize(RayScene(device, std::move(points), quads).point(0));
    } else {
      moving.set_points(points);
    }
  }
}
BENCHMARK(BM_Scene)
    ->ArgName("refit")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace crowdface
