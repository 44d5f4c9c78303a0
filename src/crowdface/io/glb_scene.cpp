// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/glb_scene.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace crowdface {

using Json = nlohmann::ordered_json;
using namespace gltf;

namespace {

double tidy(double value) {
  const double rounded = std::round(value * 1e4) / 1e4;
  return rounded == 0 ? 0.0 : rounded;
}

/// Turns `up` to +Y and `front` to +Z: x, y, z and w of a unit quaternion.
std::array<double, 4> rotation_to_gltf(Axis up, Axis front) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(1, up.index) = up.sign;
  turn(2, front.index) = front.sign;
  turn.row(0) = turn.row(1).cross(turn.row(2));
  const Eigen::Quaterniond q(turn);
  return {q.x() + 0.0, q.y() + 0.0, q.z() + 0.0, q.w() + 0.0};  // no negative zero
}

}  // namespace

Json material_json(const GlbMaterial& material, std::size_t overlay) {
  Json json = Json::object();
  if (!material.name.empty()) json["name"] = material.name;
  Json colour = Json::array();
  for (const float part : material.colour) {
    colour.push_back(material.overlay ? 1.0 : tidy(static_cast<double>(part)));
  }
  json["pbrMetallicRoughness"] = {
      {"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}};
  if (material.image) {
    json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", *material.image}};
  } else if (material.overlay) {
    json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", overlay}, {"texCoord", 1}};
  }
  if (material.roughness_image) {
    json["pbrMetallicRoughness"]["roughnessFactor"] = 1.0;
    json["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {
        {"index", *material.roughness_image}};
  }
  if (material.normal_image) json["normalTexture"] = {{"index", *material.normal_image}};
  if (material.colour[3] < 1) json["alphaMode"] = "BLEND";
  json["doubleSided"] = true;  // heads are open at the neck
  return json;
}

Json node_json(const GlbOptions& options) {
  Json node = {{"name", ""}};
  if (options.skin.joints.empty()) node = {{"mesh", 0}, {"name", ""}};
  const auto rotation = rotation_to_gltf(options.up, options.front);
  if (rotation[3] != 1) node["rotation"] = rotation;
  constexpr double kMmPerMetre = 1000;
  const double scale = mm_per(options.unit) / kMmPerMetre;
  if (scale != 1) node["scale"] = {scale, scale, scale};
  return node;
}

GlbBuffer::GlbBuffer(Json& scene) : scene_(scene) {
  scene_["buffers"] = Json::array();
  scene_["bufferViews"] = Json::array();
  scene_["accessors"] = Json::array();
}

std::size_t GlbBuffer::add_view(std::size_t size, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", size_}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  scene_["bufferViews"].push_back(std::move(view));
  size_ += size;
  return scene_["bufferViews"].size() - 1;
}

std::size_t GlbBuffer::pad() {
  const std::size_t missing = (4 - size_ % 4) % 4;
  size_ += missing;
  return missing;
}

std::size_t GlbBuffer::add_accessor(int component, const char* type, std::size_t count,
                                    std::size_t offset) {
  Json accessor = {{"bufferView", scene_["bufferViews"].size() - 1}};
  if (offset > 0) accessor["byteOffset"] = offset;
  accessor["componentType"] = component;
  accessor["count"] = count;
  accessor["type"] = type;
  scene_["accessors"].push_back(std::move(accessor));
  return scene_["accessors"].size() - 1;
}

std::size_t GlbBuffer::add_sparse(std::size_t count, std::size_t some, std::size_t indices,
                                  std::size_t values) {
  const std::size_t accessor = add_zeros(count);
  scene_["accessors"][accessor]["sparse"] = {
      {"count", some},
      {"indices", {{"bufferView", indices}, {"componentType", kUnsignedInt}}},
      {"values", {{"bufferView", values}}}};
  return accessor;
}

std::size_t GlbBuffer::add_zeros(std::size_t count) {
  scene_["accessors"].push_back({{"componentType", kFloat}, {"count", count}, {"type", "VEC3"}});
  return scene_["accessors"].size() - 1;
}

void GlbBuffer::finish() {
  scene_["buffers"].push_back(Json::object({{"byteLength", size_}}));
}

}  // namespace crowdface
