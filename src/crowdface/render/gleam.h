// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/render/texture.h"

namespace crowdface {

/// How light a face's skin is, told from its picture: three tenths of its texels are lighter (mean of the channels).
float skin_lightness(const Texture& texture);

/// What part of its gloss skin has where its colour is `albedo`: what is much darker than the skin around is
/// painted hair, which scatters what falls on it.
float skin_gleam(const Light& albedo, float skin_lightness);

}  // namespace crowdface
