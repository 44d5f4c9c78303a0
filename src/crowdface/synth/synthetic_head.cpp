// SPDX-License-Identifier: Apache-2.0
#include "crowdface/synth/synthetic_head.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/synth/hair.h"
#include "crowdface/synth/identity.h"
#include "crowdface/synth/layout.h"
#include "crowdface/synth/loose_parts.h"
#include "crowdface/synth/mean_head.h"
#include "crowdface/synth/relief.h"

namespace crowdface {
namespace {

constexpr Index kFewest = 5000, kMost = 1200000;
constexpr std::size_t kVerticesPerBlock = 1024;

}  // namespace

struct SyntheticHeads::State {
  Topology topology;
  TextureCoordinates uvs;
  std::vector<synth::Address> addresses;
  std::vector<synth::SkinPoint> mean;
  double edge_cm = 0;
  Scalp scalp = Scalp::kBare;
  std::optional<synth::LooseParts> loose;
};

SyntheticHeads::SyntheticHeads(Index vertices, Parts parts, Scalp scalp)
    : state_(std::make_unique<State>()) {
  require(vertices >= kFewest && vertices <= kMost, "synthetic heads of ", vertices, " vertices");
  // The smallest layout, 5,000 vertices, has edges of 5 mm.
  state_->scalp = scalp;
  const auto edge_of = [](Index count) {
    return 0.5 * std::sqrt(5000.0 / static_cast<double>(count));
  };
  Index skin = vertices;
  if (parts == Parts::kEyesAndTeeth) {
    state_->loose.emplace(edge_of(vertices));
    skin -= state_->loose->vertex_count();
  }
  synth::Layout layout = synth::make_layout(skin);
  state_->topology = std::move(layout.topology);
  state_->uvs = std::move(layout.uvs);
  state_->addresses = std::move(layout.addresses);
  const std::size_t n = state_->addresses.size();
  state_->mean.resize(n);
  parallel_for_each(n, kVerticesPerBlock, [&](std::size_t i) {
    state_->mean[i] = state_->loose ? synth::mean_skin_with_sockets(state_->addresses[i])
                                    : synth::mean_skin(state_->addresses[i]);
  });
  state_->edge_cm = edge_of(static_cast<Index>(n));
  if (state_->loose) state_->loose->append_to(state_->topology, state_->uvs);
}

SyntheticHeads::~SyntheticHeads() = default;

std::vector<SyntheticHeads::Piece> SyntheticHeads::pieces() const {
  std::vector<Piece> pieces = {{"skin", 0}};
  if (!state_->loose) return pieces;
  using synth::LoosePiece;
  const Index first = topology().face_count() - state_->loose->face_count();
  const auto add = [&](const char* name, LoosePiece piece) {
    pieces.push_back({name, first + state_->loose->first_face(piece)});
  };
  add("eyeball_left", LoosePiece::kLeftEye);
  add("eyeball_right", LoosePiece::kRightEye);
  add("teeth_upper", LoosePiece::kUpperTeeth);
  add("teeth_lower", LoosePiece::kLowerTeeth);
  return pieces;
}

const Topology& SyntheticHeads::topology() const {
  return state_->topology;
}
const TextureCoordinates& SyntheticHeads::uvs() const {
  return state_->uvs;
}

Positions SyntheticHeads::positions(std::uint64_t seed, std::uint64_t index) const {
  const synth::Identity identity(seed, index);
  const synth::Relief relief(identity, state_->edge_cm);
  const synth::Hair hair(seed, index);
  const bool haired = state_->scalp != Scalp::kBare;
  const double most = state_->scalp == Scalp::kShorn ? 0.2 : 10;  // cm
  Positions out(state_->topology.vertex_count, 3);
  parallel_for_each(state_->mean.size(), kVerticesPerBlock, [&](std::size_t i) {
    const synth::SkinPoint& mean = state_->mean[i];
    double height = relief.height(mean);
    if (haired && mean.relief > 0.5) height += std::min(most, hair.thickness(mean.position));
    const Eigen::Vector3d fine = mean.position + height * mean.normal;
    out.row(static_cast<Index>(i)) = identity.deform(fine).transpose();
  });
  if (state_->loose) {
    out.bottomRows(state_->loose->vertex_count()) = state_->loose->positions(identity);
  }
  return out;
}

double SyntheticHeads::edge_cm() const {
  return state_->edge_cm;
}

Positions SyntheticHeads::average() const {
  Positions out(state_->topology.vertex_count, 3);
  for (std::size_t i = 0; i < state_->mean.size(); ++i)
    out.row(static_cast<Index>(i)) = state_->mean[i].position.transpose();
  if (state_->loose) {
    out.bottomRows(state_->loose->vertex_count()) =
        state_->loose->positions(synth::Identity::average());
  }
  return out;
}

}  // namespace crowdface
