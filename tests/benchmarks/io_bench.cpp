// SPDX-License-Identifier: Apache-2.0
// Writing one face after the other of one topology: each format's encoder, and what it is held
// against. `ratio` is how many times faster than the baseline of the same run an encoder is.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <tiny_gltf.h>
#include <unistd.h>

#include "crowdface/core/parallel.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/mesh/normals.h"

#include "benchmarks/bench_size.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// A sheet of about 1.2 million vertices, with texture coordinates and a seam, as a file and in
/// memory. Its coordinates have as many digits as a blended face's.
struct Sheet {
  Mesh mesh;
  fs::path folder;
  ObjFile file;
  NormalFans fans;

  static Mesh make() {
    const auto side = static_cast<std::uint32_t>(bench::size(1095, 40));
    Mesh mesh;
    mesh.topology = testing::grid_topology(side, side);
    mesh.topology.corner_uvs = mesh.topology.corner_vertices;
    const auto stride = side + 1;
    for (std::uint32_t& uv : mesh.topology.corner_uvs) {
      if (uv % stride == stride / 2) uv = uv / stride;  // a seam, of another piece's coordinates
    }
    mesh.positions = 12 * testing::random_positions(mesh.topology.vertex_count, 1);
    mesh.uvs = testing::random_positions(mesh.topology.vertex_count, 2).leftCols<2>();
    return mesh;
  }

  Sheet()
      : mesh(make()),
        folder(fs::temp_directory_path() / ("crowdface_io_bench_" + std::to_string(::getpid()))),
        fans(mesh.topology) {
    fs::create_directories(folder);
    encode_obj(mesh, "").write(folder / "target.obj");
    file = read_obj(folder / "target.obj");
  }
  ~Sheet() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
};

const Sheet& sheet() {
  static const Sheet only;
  return only;
}

/// What fprintf makes of it, as most programs write OBJ files; nine digits read back exactly.
void print_obj(const Mesh& mesh, const fs::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const Topology& topology = mesh.topology;
  for (Index i = 0; i < mesh.positions.rows(); ++i) {
    std::fprintf(file, "v %.9g %.9g %.9g\n", mesh.positions(i, 0), mesh.positions(i, 1),
                 mesh.positions(i, 2));
  }
  for (Index i = 0; i < mesh.uvs.rows(); ++i) {
    std::fprintf(file, "vt %.9g %.9g\n", mesh.uvs(i, 0), mesh.uvs(i, 1));
  }
  for (std::size_t f = 0; f + 1 < topology.face_offsets.size(); ++f) {
    std::fputc('f', file);
    for (auto c = topology.face_offsets[f]; c < topology.face_offsets[f + 1]; ++c) {
      std::fprintf(file, " %u/%u", topology.corner_vertices[c] + 1, topology.corner_uvs[c] + 1);
    }
    std::fputc('\n', file);
  }
  std::fflush(file);
  ::fsync(::fileno(file));
  std::fclose(file);
}

/// Through tinygltf, as its examples do: one model a face, written to a stream in memory.
std::string tinygltf_glb(const std::string& one_of_ours) {
  tinygltf::TinyGLTF library;
  static const tinygltf::Model shared = [&] {
    tinygltf::Model model;
    std::string error, warning;
    library.LoadBinaryFromMemory(&model, &error, &warning,
                                 reinterpret_cast<const unsigned char*>(one_of_ours.data()),
                                 static_cast<unsigned>(one_of_ours.size()));
    return model;
  }();
  std::ostringstream stream;
  library.WriteGltfSceneToStream(&shared, stream, false, true);
  return stream.str();
}

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The baseline takes its turn in every iteration, untimed, so that both meet the same machine.
/// Files of an earlier turn are out of the way: to replace one costs what its size says. The best
/// turns are compared, those that other programs disturbed least.
void compare(benchmark::State& state, const fs::path& folder, const auto& baseline,
             const auto& ours) {
  double theirs = 1e9, own = 1e9;
  const auto clear = [&] {
    for (const char* name : {"face", "printed"}) fs::remove(folder / name);
  };
  for (auto _ : state) {
    state.PauseTiming();
    clear();
    state.ResumeTiming();
    own = std::min(own, seconds_of(ours));
    state.PauseTiming();
    clear();
    theirs = std::min(theirs, seconds_of(baseline));
    state.ResumeTiming();
  }
  state.counters["best_ms"] = 1e3 * own;
  state.counters["baseline_ms"] = 1e3 * theirs;
  state.counters["ratio"] = theirs / own;
}

void BM_WriteObj(benchmark::State& state) {
  const Sheet& s = sheet();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const ObjTemplate form(s.file, s.mesh.topology);
  std::uint64_t bytes = 0;
  compare(
      state, s.folder, [&] { print_obj(s.mesh, s.folder / "printed"); },
      [&] {
        const EncodedFile file = form.encode(s.mesh.positions, "face");
        file.write(s.folder / "face");
        bytes = file.size();
      });
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}
BENCHMARK(BM_WriteObj)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_EncodeObj(benchmark::State& state) {
  const Sheet& s = sheet();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const ObjTemplate form(s.file, s.mesh.topology);
  for (auto _ : state) benchmark::DoNotOptimize(form.encode(s.mesh.positions, "face").size());
}
BENCHMARK(BM_EncodeObj)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_VertexNormals(benchmark::State& state) {
  const Sheet& s = sheet();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(vertex_normals(s.fans, s.mesh.topology, s.mesh.positions).data());
  }
}
BENCHMARK(BM_VertexNormals)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Writes again and again what `encode` makes.
void write_each(benchmark::State& state, const auto& encode) {
  const Sheet& s = sheet();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    fs::remove(s.folder / "face");
    state.ResumeTiming();
    const EncodedFile file = encode();
    file.write(s.folder / "face");
    bytes = file.size();
  }
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}

void BM_WritePly(benchmark::State& state) {
  const PlyTemplate form(sheet().mesh.topology);
  write_each(state, [&] { return form.encode(sheet().mesh.positions, {}, "face"); });
}
BENCHMARK(BM_WritePly)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_WriteGlb(benchmark::State& state) {
  const Sheet& s = sheet();
  const GlbTemplate form(s.mesh.topology, s.mesh.uvs, {});
  write_each(state, [&] {
    const Positions normals = vertex_normals(s.fans, s.mesh.topology, s.mesh.positions);
    return form.encode(s.mesh.positions, normals, "face");
  });
}
BENCHMARK(BM_WriteGlb)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_WritePoints(benchmark::State& state) {
  write_each(state, [&] { return encode_npy(sheet().mesh.positions, "face"); });
}
BENCHMARK(BM_WritePoints)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// In memory, normals given: what our own container saves against tinygltf's writer.
void BM_EncodeGlb(benchmark::State& state) {
  const Sheet& s = sheet();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const GlbTemplate form(s.mesh.topology, s.mesh.uvs, {});
  const Positions normals = vertex_normals(s.fans, s.mesh.topology, s.mesh.positions);
  const std::string one = form.encode(s.mesh.positions, normals, "face").text();
  compare(
      state, s.folder, [&] { benchmark::DoNotOptimize(tinygltf_glb(one).size()); },
      [&] { benchmark::DoNotOptimize(form.encode(s.mesh.positions, normals, "face").size()); });
}
BENCHMARK(BM_EncodeGlb)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_PrepareTemplates(benchmark::State& state) {
  const Sheet& s = sheet();
  std::size_t obj = 0, ply = 0, glb = 0;
  for (auto _ : state) {
    obj = ObjTemplate(s.file, s.mesh.topology).memory_bytes();
    ply = PlyTemplate(s.mesh.topology).memory_bytes();
    glb = GlbTemplate(s.mesh.topology, s.mesh.uvs, {}).memory_bytes();
  }
  state.counters["obj_MB"] = static_cast<double>(obj) / 1e6;
  state.counters["ply_MB"] = static_cast<double>(ply) / 1e6;
  state.counters["glb_MB"] = static_cast<double>(glb) / 1e6;
}
BENCHMARK(BM_PrepareTemplates)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace crowdface
