// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gtest/gtest.h>
#include <tiny_gltf.h>

namespace crowdface::testing {

/// A file as tinygltf reads it, which shares nothing with the writer and must find nothing wrong.
inline tinygltf::Model load_glb(const std::string& bytes) {
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(loader.LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned>(bytes.size()), "", tinygltf::REQUIRE_ALL));
  EXPECT_EQ(error + warning, "");
  return model;
}

}  // namespace crowdface::testing
