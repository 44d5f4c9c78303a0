// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/paint_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "crowdface/core/parallel.h"
#include "crowdface/texture/fill_uncovered.h"
#include "crowdface/texture/row_kernels.h"

namespace crowdface {
namespace {

constexpr int kPictureRowsPerBlock = 16;

/// For each channel, the sum of the values of the covered texels of a row.
using RowSums = std::array<std::uint64_t, 3>;

/// Working memory for blending rows of texels.
struct RowBuffer {
  RowBuffer(int width, const VertexFactorsOfImage& fields)
      : ramps(2 * (fields.values_per_vertex() + kRowSlack)), heads(fields.heads.size()) {
    const std::size_t stride = static_cast<std::size_t>(width) + kRowSlack;
    values.resize(stride * fields.channels);
    for (std::size_t c = 0; c < fields.channels; ++c) sums.push_back(values.data() + c * stride);
  }
  RowBuffer(const RowBuffer&) = delete;
  RowBuffer& operator=(const RowBuffer&) = delete;

  std::vector<float> values, ramps;
  std::vector<StoredRow> heads;
  /// for each channel: pointer to the first blended value of the row of texels, inside `values`
  std::vector<float*> sums;
};

/// Blends the covered texels of row y, span by span from left to right. Blending a span may also
/// change up to kRowSlack values beyond the end of the span. The next span is blended later, so its
/// values are correct.
void blend_row(const SurfaceTexels& texels, int y, const VertexFactorsOfImage& fields,
               const std::vector<std::shared_ptr<const TextureMap>>& maps, RowBuffer& buffer) {
  for (std::size_t h = 0; h < fields.heads.size(); ++h) {
    for (std::size_t c = 0; c < fields.channels; ++c) {
      buffer.heads[h][c] = maps[fields.heads[h]]->row(static_cast<int>(c), y);
    }
  }
  // The SIMD kernels may read up to kRowSlack texels beyond the end of a row, which belong to the
  // next row. After the last row of the image, there are no such texels.
  const auto width = static_cast<std::size_t>(texels.width());
  const std::size_t readable = y + 1 < texels.height() ? width + kRowSlack : width;
  const auto row = static_cast<float>(y);
  const std::size_t fields_per_vertex = fields.values_per_vertex();
  for (const SurfaceTexels::Span& span : texels.row(y)) {
    const SurfaceTexels::Triangle& triangle = texels.triangle(span.triangle);
    const auto& [b, b_step, b_per_row] = triangle.second_barycentric;
    const auto& [c, c_step, c_per_row] = triangle.third_barycentric;
    const auto begin = static_cast<float>(span.begin);
    const auto corner = [&](std::size_t k) {
      return fields.values.data() + fields_per_vertex * triangle.corners[k];
    };
    blend_texels({{corner(0), corner(1), corner(2)},
                  fields_per_vertex,
                  {b + row * b_per_row + begin * b_step, c + row * c_per_row + begin * c_step},
                  {b_step, c_step}},
                 buffer.heads, span.begin, span.end, readable, buffer.ramps, buffer.sums);
  }
}

std::uint16_t word_of(float share) {
  return static_cast<std::uint16_t>(std::clamp(65535 * share + 0.5F, 0.0F, 65535.0F));
}

/// Writes the colours of the covered texels of one row as sRGB bytes.
/// \param sums  the blended optical densities of the texels (base + Σ_h factor_h · map_h), one row
///              per channel.
/// \param out   the row of bytes.
/// \return for each channel: the sum of the written bytes.
RowSums write_colours(std::span<const SurfaceTexels::Span> spans, std::span<float* const> sums,
                      std::uint8_t* out) {
  static const std::uint8_t* const srgb8 = srgb8_by_density().data();
  RowSums total = {};
  const auto byte_at = [&](std::size_t c, std::size_t x) {
    const float density = std::clamp(sums[c][x] + 0.5F, 0.0F, kMaxDensity);
    return srgb8[static_cast<std::size_t>(static_cast<int>(density))];
  };
  for (const SurfaceTexels::Span& span : spans) {
    for (std::size_t x = span.begin; x < span.end; ++x) {
      for (std::size_t c = 0; c < 3; ++c) total[c] += out[3 * x + c] = byte_at(c, x);
    }
  }
  return total;
}

/// Like write_colours, but converts slopes to unit normals.
RowSums write_normals(std::span<const SurfaceTexels::Span> spans, std::span<float* const> sums,
                      std::uint16_t* out) {
  RowSums total = {};
  for (std::size_t i = 0; i < spans.size();) {
    const std::size_t begin = spans[i].begin;
    std::size_t end = begin;
    while (i < spans.size() && spans[i].begin == end) end = spans[i++].end;
    const RowSums of_run =
        write_unit_normals({sums[0] + begin, sums[1] + begin}, end - begin, out + 3 * begin);
    for (std::size_t c = 0; c < 3; ++c) total[c] += of_run[c];
  }
  return total;
}

RowSums write_values(std::span<const SurfaceTexels::Span> spans, std::span<float* const> sums,
                     const BlendedPicture& picture, std::uint16_t* out) {
  RowSums total = {};
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (const SurfaceTexels::Span& span : spans) {
    for (std::size_t x = span.begin; x < span.end; ++x) {
      for (std::size_t c = 0; c < channels; ++c) {
        total[c] += out[channels * x + c] =
            word_of((sums[c][x] - picture.low) / (65535 * picture.step));
      }
    }
  }
  return total;
}

/// Fills uncovered texels with the mean of the covered texels, and then copies covered texels into
/// the gutter.
/// \param sums    for each row, the sums of the covered texels.
/// \param values  height by width by `channels`.
template <class Value>
void fill_rest(const SurfaceTexels& texels, const std::vector<RowSums>& sums, std::size_t channels,
               std::vector<Value>& values) {
  std::array<Value, 3> fill = {};
  for (std::size_t c = 0; c < channels; ++c) {
    std::uint64_t sum = 0;
    for (const RowSums& row : sums) sum += row[c];
    fill[c] = static_cast<Value>(sum / std::max<std::size_t>(1, texels.covered_texel_count()));
  }
  fill_uncovered(texels, std::span<const Value>(fill).first(channels), values.data());
}

/// Returns a texture image of the right size and encoding, without values for the texels.
BlendedPicture blank_picture(const SurfaceTexels& texels, const MapCoding& coding) {
  BlendedPicture picture{texels.width(), texels.height(), {}};
  const std::size_t count =
      static_cast<std::size_t>(texels.width()) * static_cast<std::size_t>(texels.height());
  if (coding.content == MapContent::kColours) {
    picture.srgb.resize(3 * count);
    return picture;
  }
  if (coding.content == MapContent::kValues) {
    picture.channels = coding.channels;
    picture.low = coding.low;
    picture.step = coding.step;
  }
  picture.values_16_bit.resize(static_cast<std::size_t>(picture.channels) * count);
  return picture;
}

}  // namespace

BlendedPicture paint_picture(const SurfaceTexels& texels, const MapCoding& coding,
                             const std::vector<std::shared_ptr<const TextureMap>>& maps,
                             const VertexFactorsOfImage& fields) {
  BlendedPicture result = blank_picture(texels, coding);
  const auto channels = static_cast<std::size_t>(result.channels);
  std::vector<RowSums> row_sums(static_cast<std::size_t>(texels.height()));
  parallel_blocks(texels.height(), kPictureRowsPerBlock, [&](int begin, int end) {
    RowBuffer buffer(texels.width(), fields);
    const std::span<float* const> sums = buffer.sums;
    for (int y = begin; y < end; ++y) {
      const auto spans = texels.row(y);
      if (spans.empty()) continue;
      blend_row(texels, y, fields, maps, buffer);
      const std::size_t row =
          channels * static_cast<std::size_t>(texels.width()) * static_cast<std::size_t>(y);
      RowSums& total = row_sums[static_cast<std::size_t>(y)];
      if (coding.content == MapContent::kColours) {
        total = write_colours(spans, sums, result.srgb.data() + row);
      } else if (coding.content == MapContent::kSlopes) {
        total = write_normals(spans, sums, result.values_16_bit.data() + row);
      } else {
        total = write_values(spans, sums, result, result.values_16_bit.data() + row);
      }
    }
  });
  if (result.values_16_bit.empty()) {
    fill_rest(texels, row_sums, channels, result.srgb);
  } else {
    fill_rest(texels, row_sums, channels, result.values_16_bit);
  }
  return result;
}

}  // namespace crowdface
