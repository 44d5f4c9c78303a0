// SPDX-License-Identifier: Apache-2.0
// Heads are read once: then the cache knows them, is never trusted when damaged, and sees any
// change.
#include "crowdface/heads/read_heads.h"

#include <array>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "crowdface/core/input_limits.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/forged_entry.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::crowd_files;
using testing::differing_files;
using testing::read_text;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

/// Heads just large enough to be kept.
SmallCrowd large_heads() {
  SmallCrowd crowd;
  crowd.heads = 2;
  crowd.count = 1;
  crowd.bowl.columns = crowd.bowl.rows = 100;
  crowd.bowl.normals = true;
  crowd.bowl.materials = true;
  crowd.smoothing_limit = "max_iterations: 3";
  crowd.levels = "cubic";
  return crowd;
}

// A head without an mtllib line was grey without a word.
TEST(ReadHeads, UseTheTextureBesideAHeadThatNamesNone) {
  SmallCrowd crowd;
  crowd.heads = 2;
  const SmallCrowdFolder folder(crowd);
  const fs::path head = folder.head(folder.names()[0]);
  const std::string text = read_text(head);
  folder.folder().write("heads/" + folder.names()[0] + ".obj", "# Exported\n" + text);
  const auto read = [&] {
    Problems problems;
    const std::vector<HeadFile> heads =
        read_heads({head, folder.head(folder.names()[1])}, folder.out(), problems);
    problems.throw_if_any();
    EXPECT_EQ(heads[0].mesh, heads[1].mesh);
    EXPECT_TRUE(heads[1].file.material_libraries.empty());
    return heads[0].file;
  };
  EXPECT_TRUE(read().material_libraries.empty());
  const std::string stem = head.stem().string();
  folder.folder().write("heads/" + stem + ".PNG",
                        encode_png(1, 1, 3, std::vector<std::uint8_t>{255, 0, 0}));
  const ObjFile textured = read();
  EXPECT_EQ(textured.file.bytes(), "mtllib " + stem + ".mtl\n" + text);
  const NamedTextures named = find_textures(textured.material_path(), textured.material_libraries);
  ASSERT_EQ(named.paths_by_kind.count(TextureKind::kColour), 1U);
  EXPECT_FALSE(named.single_material.empty());
  EXPECT_EQ(read_image(named.paths_by_kind.at(TextureKind::kColour).begin()->second).width, 1);
  folder.folder().write("heads/" + stem + ".mtl", "newmtl skin\nKd 1 0 0\n");
  EXPECT_EQ(read().material_path(), head);
}

class KeptHeads : public ::testing::Test {
 protected:
  KeptHeads() : folder_(large_heads()) {
    run();
    first_ = crowd_files(folder_.out());
  }

  void run() {
    fs::remove_all(folder_.out());
    testing::run(folder_);
  }
  std::string log() const { return read_text(folder_.out() / "crowdface.log"); }
  std::string error_of_job(const fs::path& cache) const {
    try {
      load_job(folder_.config(), {}, cache);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  fs::path entry_of(const std::string& head) const {
    return cache_entry(folder_.cache(),
                       key_of_read_head(hash_bytes(read_text(folder_.head(head)))));
  }
  fs::path mesh() const {
    for (const fs::path& entry : list_cache(folder_.cache()).entries) {
      if (entry.filename().string().starts_with("mesh")) return entry;
    }
    return {};
  }

  SmallCrowdFolder folder_;
  std::map<std::string, std::string> first_;
};

constexpr const char* kBoth = "2 of 2 heads were read from the cache";

TEST_F(KeptHeads, AreReadOnceAndGiveTheSameCrowd) {
  ASSERT_GE(fs::file_size(folder_.head("ann")), kMinCachedBytes);
  EXPECT_THAT(log(), ::testing::Not(::testing::HasSubstr("heads were read from the cache")));
  const CacheContents contents = list_cache(folder_.cache());
  EXPECT_EQ(contents.loaded_head_count, 2U);
  EXPECT_EQ(contents.prepared_head_count, 2U);
  EXPECT_EQ(contents.entries.size(), 7U) << "one mesh, patches and a face space of both";
  run();
  EXPECT_THAT(log(), ::testing::HasSubstr(kBoth));
  EXPECT_THAT(differing_files(crowd_files(folder_.out()), first_), ::testing::IsEmpty());
}

TEST_F(KeptHeads, ChangeOnDiskIsSeenWhateverTheClockSays) {
  const fs::path head = folder_.head("ann");
  const auto time = fs::last_write_time(head);
  std::string text = read_text(head);
  const std::size_t digit = text.find_first_of("123456789", text.find("\nv ") + 3);
  text[digit] = text[digit] == '1' ? '2' : '1';
  folder_.folder().write("heads/ann.obj", text);
  fs::last_write_time(head, time);
  run();
  EXPECT_THAT(log(), ::testing::HasSubstr("1 of 2 heads were read from the cache"));
  const auto changed = crowd_files(folder_.out());
  EXPECT_THAT(differing_files(changed, first_), ::testing::Not(::testing::IsEmpty()));
  fs::remove_all(folder_.cache());
  run();
  EXPECT_THAT(differing_files(crowd_files(folder_.out()), changed), ::testing::IsEmpty());
}

TEST_F(KeptHeads, DamagedForgedAndForeignEntriesAreReadPast) {
  const fs::path entry = entry_of("ann"), mesh = this->mesh();
  const std::string head_bytes = read_text(entry), mesh_bytes = read_text(mesh);
  const auto of_head = [&](std::string_view array, auto number) {
    return std::pair(entry, testing::forged_array(head_bytes, array, 0, number));
  };
  const auto of_mesh = [&](std::string_view array, auto number) {
    return std::pair(mesh, testing::forged_array(mesh_bytes, array, 0, number));
  };
  std::string flipped = head_bytes;
  flipped[1000] = static_cast<char>(flipped[1000] ^ 1);
  constexpr std::uint64_t kHuge = std::numeric_limits<std::uint64_t>::max() / 2;
  const std::vector<std::pair<fs::path, std::string>> damaged = {
      {entry, ""},
      {entry, "x"},
      {entry, head_bytes.substr(0, 4096)},
      {entry, head_bytes.substr(0, head_bytes.size() - 1)},
      {entry, head_bytes + "x"},
      {entry, flipped},
      {entry, testing::forged_at(head_bytes, 8, std::uint32_t{999})},  // version
      {entry, testing::forged_at(head_bytes, 16, std::uint64_t{1})},   // of another text
      {entry, mesh_bytes},
      of_head("positions", std::numeric_limits<double>::quiet_NaN()),
      of_head("positions", 1e30),
      of_head("materials sizes", kHuge),
      of_head("materials faces", kHuge),
      {mesh, mesh_bytes.substr(0, 5000)},
      {mesh, mesh_bytes + "x"},
      {mesh, testing::forged_at(mesh_bytes, 8, std::uint32_t{999})},
      of_mesh("vertices", std::uint64_t{7}),  // corners of others
      of_mesh("vertices", kHuge),             // of another size than positions
      of_mesh("face offsets", std::uint32_t{1}),
      of_mesh("corner uvs", kNoIndex - 1),
      of_mesh("uvs", 1e30),
      of_mesh("corner vertices", std::uint32_t{1U << 30U})};
  for (const auto& [path, bytes] : damaged) {
    SCOPED_TRACE(concat(path.filename().string(), ' ', bytes.size()));
    folder_.folder().write("cache/" + path.filename().string(), bytes);
    run();
    EXPECT_THAT(log(), ::testing::Not(::testing::HasSubstr(kBoth)));
    EXPECT_THAT(log(), ::testing::HasSubstr("it is created again"));
    EXPECT_THAT(differing_files(crowd_files(folder_.out()), first_), ::testing::IsEmpty());
    EXPECT_TRUE(read_text(path) == (path == entry ? head_bytes : mesh_bytes)) << "made anew";
  }
}

TEST_F(KeptHeads, MeshThatIsGoneIsMadeAnew) {
  const fs::path mesh = this->mesh();
  const std::string bytes = read_text(mesh);
  fs::remove(mesh);
  run();
  EXPECT_TRUE(read_text(mesh) == bytes);
  EXPECT_THAT(differing_files(crowd_files(folder_.out()), first_), ::testing::IsEmpty());
}

TEST_F(KeptHeads, OtherMeshIsToldAsWithoutCache) {
  std::string text = read_text(folder_.head("bob"));
  const std::size_t face = text.find("\nf ") + 3;
  const std::size_t blank = text.find(' ', face), next = text.find_first_of(" \r\n", blank + 1);
  text = concat(text.substr(0, face), text.substr(blank + 1, next - blank - 1), ' ',
                text.substr(face, blank - face), text.substr(next));
  folder_.folder().write("heads/bob.obj", text);
  const std::string expected = error_of_job({});
  ASSERT_THAT(expected, ::testing::HasSubstr("not the same mesh as"));
  EXPECT_EQ(error_of_job(folder_.cache()), expected);
  EXPECT_FALSE(fs::exists(entry_of("bob"))) << "heads that do not belong together are not kept";
  Problems problems;
  cache_heads(read_heads({folder_.head("bob")}, {}, problems), folder_.cache());
  ASSERT_TRUE(fs::exists(entry_of("bob")));
  EXPECT_EQ(error_of_job(folder_.cache()), expected);
}

TEST_F(KeptHeads, SmallerLimitsHoldForThemToo) {
  const auto problems_of = [&] {
    Problems problems;
    read_heads({folder_.head("ann")}, folder_.cache(), problems);
    return problems.size();
  };
  EXPECT_EQ(problems_of(), 0U);
  const std::uint64_t limit = input_limits().vertices;
  set_input_limit("vertices=100");
  EXPECT_EQ(problems_of(), 1U);
  set_input_limit(concat("vertices=", limit));
}

TEST_F(KeptHeads, CacheThatCannotBeWrittenToOnlyWarns) {
  folder_.folder().write("taken", "a file in the place of the folder");
  fs::remove_all(folder_.out());
  generate(folder_.config(), {}, {folder_ / "taken", Replace::kRefuse, false});
  EXPECT_THAT(log(), ::testing::HasSubstr("heads cannot be stored in the cache"));
  EXPECT_THAT(differing_files(crowd_files(folder_.out()), first_), ::testing::IsEmpty());
}

/// Three heads of one mesh, and one of another.
class SideBySide : public ::testing::Test {
 protected:
  SideBySide() : folder_(four_heads()) {
    for (const char* name : {"ann", "bob", "cyd", "dan"}) paths_.push_back(folder_.head(name));
    const std::string face = "f 2/2/2 1/1/1 4/4/4 5/5/5\n";
    write("dan", read_text(paths_[3]) + face);
  }
  static SmallCrowd four_heads() {
    SmallCrowd crowd;
    crowd.heads = 4;
    crowd.bowl.normals = true;
    return crowd;
  }
  void write(const std::string& name, const std::string& text) {
    folder_.folder().write("heads/" + name + ".obj", text);
  }
  std::vector<HeadFile> read(std::string* told = nullptr) const {
    Problems problems;
    std::vector<HeadFile> heads = read_heads(paths_, {}, problems);
    try {
      problems.throw_if_any();
    } catch (const Error& error) {
      if (told != nullptr) *told = error.what();
    }
    return heads;
  }

  SmallCrowdFolder folder_;
  std::vector<fs::path> paths_;
};

TEST_F(SideBySide, AMeshIsReadOnceAndIsThatOfEachText) {
  const std::vector<HeadFile> heads = read();
  ASSERT_EQ(heads.size(), 4U);
  for (const HeadFile& head : heads) {
    const ObjFile alone = read_obj(head.file.path);
    EXPECT_EQ(head.mesh->topology.corner_vertices, alone.topology.corner_vertices);
    EXPECT_EQ(head.mesh->topology.corner_uvs, alone.topology.corner_uvs);
    EXPECT_EQ(head.mesh->topology.face_offsets, alone.topology.face_offsets);
    EXPECT_EQ(head.mesh->topology.vertex_count, alone.topology.vertex_count);
    EXPECT_EQ(head.mesh->corner_normals, alone.corner_normals);
    EXPECT_EQ(head.mesh->uvs, alone.uvs);
    EXPECT_EQ(head.file.positions, alone.positions);
    EXPECT_EQ(head.mesh_digest, head.mesh->digest());
  }
  EXPECT_EQ(heads[1].mesh, heads[0].mesh);
  EXPECT_EQ(heads[2].mesh, heads[0].mesh);
  EXPECT_NE(heads[3].mesh, heads[0].mesh);
}

// Read first, it was flipped, and was said to have another mesh than the others.
TEST_F(SideBySide, AMirroredHeadKeepsTheMeshOfTheOthers) {
  const ObjFile plain = read_obj(paths_[0]);
  Positions mirrored = plain.positions;
  mirrored.col(0) *= -1;
  write("ann", ObjTemplate(plain, plain.topology).encode(mirrored, "ann").text());
  const ThreadLimit one(1);
  const std::vector<HeadFile> heads = read();
  ASSERT_EQ(heads.size(), 4U);
  EXPECT_EQ(heads[0].mesh, heads[1].mesh);
  EXPECT_EQ(heads[0].file.positions, mirrored);
  EXPECT_TRUE(heads[0].file.notes.empty());
}

TEST_F(SideBySide, AHeadThatCannotBeReadLeavesTheOthersTheirMesh) {
  for (const char* name : {"ann", "bob", "cyd"}) {
    const std::string text = read_text(folder_.head(name));
    std::string bad = text;
    bad.replace(bad.find("\nv ") + 3, 1, "x");
    write(name, bad);
    std::string told;
    const std::vector<HeadFile> heads = read(&told);
    ASSERT_EQ(heads.size(), 3U);
    for (const HeadFile& head : heads) {
      EXPECT_EQ(head.mesh->topology.corner_vertices,
                read_obj(head.file.path).topology.corner_vertices);
    }
    EXPECT_THAT(told, ::testing::HasSubstr(concat(name, ".obj:")));
    write(name, text);
  }
}

// Only the first head was repaired; the others were refused.
TEST_F(SideBySide, EachHeadIsRepaired) {
  const std::vector<HeadFile> sound = read();
  const auto with = [](std::string text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
    return text;
  };
  for (const char* name : {"ann", "bob", "cyd"}) {
    std::string text = read_text(folder_.head(name));
    text = with(text, "\nvn ", "\nvn -nan(ind) -1.#IND ");
    text.insert(text.find('\n', text.find("\nv ") + 1), " # first");
    std::ranges::replace(text, '\n', '\r');
    write(name, text);
  }
  std::string told;
  const std::vector<HeadFile> heads = read(&told);
  EXPECT_EQ(told, "");
  ASSERT_EQ(heads.size(), 4U);
  for (std::size_t h = 0; h < 4; ++h) {
    EXPECT_EQ(heads[h].file.positions, sound[h].file.positions);
    EXPECT_EQ(heads[h].mesh->topology.corner_vertices, sound[h].mesh->topology.corner_vertices);
  }
  EXPECT_EQ(heads[1].mesh, heads[0].mesh);
}

TEST_F(SideBySide, AMeshThatIsBadIsToldOfEach) {
  for (const char* name : {"ann", "bob", "cyd"}) {
    write(name, read_text(folder_.head(name)) + "f 1 2 999999\n");
  }
  std::string told;
  EXPECT_EQ(read(&told).size(), 1U);
  for (const char* name : {"ann.obj:", "bob.obj:", "cyd.obj:"}) {
    EXPECT_THAT(told, ::testing::HasSubstr(name));
  }
}

/// Heads as GLB files that hold a picture each.
class TexturedFiles : public ::testing::Test {
 protected:
  TexturedFiles() : folder_(crowd()) {
    for (std::size_t h = 0; h < folder_.names().size(); ++h) {
      const fs::path obj = folder_.head(folder_.names()[h]);
      const ObjFile head = read_obj(obj);
      GlbOptions options;
      options.unit = LengthUnit::kCentimetre;
      options.materials = {{.name = "Skin", .image = 0}};
      options.images = {{"image/png", ""}};
      const auto tone = static_cast<std::uint8_t>(60 + 40 * h);
      const std::string picture = encode_png(8, 8, 3, std::vector<std::uint8_t>(192, tone));
      const std::array<std::string_view, 1> images = {picture};
      GlbTemplate(head.topology, head.uvs, options)
          .encode(head.positions, vertex_normals(head.topology, head.positions), "head", {}, images)
          .write(fs::path(obj).replace_extension(".glb"));
      fs::remove(obj);
      paths_.push_back(fs::path(obj).replace_extension(".glb"));
    }
  }
  static SmallCrowd crowd() {
    SmallCrowd crowd;
    crowd.heads = 3;
    crowd.count = 2;
    crowd.more = "\noutput: {directory: out, contact_sheet: none, meshes: [obj]}";
    return crowd;
  }

  SmallCrowdFolder folder_;
  std::vector<fs::path> paths_;
};

TEST_F(TexturedFiles, HaveTheirTexturesWithAnyCacheAndWithout) {
  for (const fs::path& cache : {folder_.cache(), fs::path(), paths_.front() / "cache"}) {
    Problems problems;
    const std::vector<HeadFile> heads = read_heads(paths_, cache, problems);
    ASSERT_EQ(heads.size(), 3U) << cache;
    for (const HeadFile& head : heads) {
      const ObjFile& file = head.file;
      const NamedTextures named = find_textures(file.material_path(), file.material_libraries);
      EXPECT_TRUE(named.warnings.empty());
      const auto& of_colour = named.paths_by_kind.at(TextureKind::kColour);
      ASSERT_TRUE(of_colour.contains("Skin")) << cache;
      EXPECT_EQ(read_image(of_colour.at("Skin")).width, 8);
      EXPECT_EQ(file.materials.at(0).name, "Skin");
    }
  }
  EXPECT_EQ(list_cache(folder_.cache()).entries.size(), 3U);
  EXPECT_EQ(clear_cache(folder_.cache()), 3U);
  EXPECT_TRUE(fs::is_empty(folder_.cache()));
}

}  // namespace
}  // namespace crowdface
