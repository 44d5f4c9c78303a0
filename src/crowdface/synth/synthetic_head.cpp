// SPDX-License-Identifier: Apache-2.0
#include "crowdface/synth/synthetic_head.h"

#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/synth/identity.h"
#include "crowdface/synth/layout.h"
#include "crowdface/synth/mean_head.h"
#include "crowdface/synth/relief.h"

namespace crowdface {
namespace {

constexpr Index kFewest = 5000, kMost = 1200000;
constexpr std::ptrdiff_t kBlock = 1024;

}  // namespace

struct SyntheticHeads::State {
  Topology topology;
  TextureCoordinates uvs;
  std::vector<synth::Address> addresses;
  std::vector<synth::SkinPoint> mean;
};

SyntheticHeads::SyntheticHeads(Index vertices) : state_(std::make_unique<State>()) {
  if (vertices < kFewest || vertices > kMost) {
    throw InvalidInput(concat("expected ", kFewest, " to ", kMost,
                              " vertices for synthetic heads, found ", vertices));
  }
  synth::Layout layout = synth::make_layout(vertices);
  state_->topology = std::move(layout.topology);
  state_->uvs = std::move(layout.uvs);
  state_->addresses = std::move(layout.addresses);
  const std::size_t n = state_->addresses.size();
  state_->mean.resize(n);
  parallel_blocks(static_cast<std::ptrdiff_t>(n), kBlock, [&](auto begin, auto end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      state_->mean[i] = synth::mean_skin(state_->addresses[i]);
    }
  });
}

SyntheticHeads::~SyntheticHeads() = default;
SyntheticHeads::SyntheticHeads(SyntheticHeads&&) noexcept = default;
SyntheticHeads& SyntheticHeads::operator=(SyntheticHeads&&) noexcept = default;

const Topology& SyntheticHeads::topology() const {
  return state_->topology;
}
const TextureCoordinates& SyntheticHeads::uvs() const {
  return state_->uvs;
}

Positions SyntheticHeads::positions(std::uint64_t seed, std::uint64_t index) const {
  const synth::Identity identity(seed, index);
  // The smallest layout, 5,000 vertices, has edges of 5 mm.
  const double edge_cm = 0.5 * std::sqrt(5000.0 / static_cast<double>(topology().vertex_count));
  const synth::Relief relief(identity, edge_cm);
  Positions out(state_->topology.vertex_count, 3);
  parallel_blocks(out.rows(), kBlock, [&](auto begin, auto end) {
    for (auto i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const synth::SkinPoint& mean = state_->mean[k];
      const Eigen::Vector3d fine = mean.position + relief.height(mean) * mean.normal;
      out.row(i) = identity.deform(fine).transpose();
    }
  });
  return out;
}

}  // namespace crowdface
