// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace crowdface {

/// What a texture stores. Each kind corresponds to a statement of material files (MTL).
enum class TextureKind { kColour, kNormal, kRoughness, kSpecular, kDisplacement, kBump };

/// The line of material files (MTL) that names a texture of one kind, such as "map_Kd skin.png".
struct TextureStatement {
  TextureKind kind;
  std::string_view word;  ///< first word of the line, as this program writes it
  std::string_view name;  ///< name of the kind in file names
};

/// The statements of MTL files that name textures: one for each TextureKind, in the order of the
/// enumeration. `map_Bump`, also spelled `map_bump` and `bump`, names height maps; many programs
/// use it for normal maps.
inline constexpr std::array kTextureStatements = {
    TextureStatement{TextureKind::kColour, "map_Kd", "colour"},
    TextureStatement{TextureKind::kNormal, "norm", "normal"},
    TextureStatement{TextureKind::kRoughness, "map_Pr", "roughness"},
    TextureStatement{TextureKind::kSpecular, "map_Ks", "specular"},
    TextureStatement{TextureKind::kDisplacement, "disp", "displacement"},
    TextureStatement{TextureKind::kBump, "map_Bump", "bump"}};

/// Whether previews show textures of this kind in addition to colour maps.
constexpr bool is_shown_in_previews(TextureKind kind) {
  return kind == TextureKind::kNormal || kind == TextureKind::kRoughness;
}

/// The MTL statement that names textures of this kind.
constexpr const TextureStatement& mtl_statement_of(TextureKind kind) {
  return kTextureStatements[static_cast<std::size_t>(kind)];
}

/// The kind of texture that a statement names; nothing if the word names no texture.
constexpr std::optional<TextureKind> texture_kind_of(std::string_view word) {
  if (word == "map_bump" || word == "bump") return TextureKind::kBump;
  for (const TextureStatement& statement : kTextureStatements) {
    if (statement.word == word) return statement.kind;
  }
  return std::nullopt;
}

}  // namespace crowdface
