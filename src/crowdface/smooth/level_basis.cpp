// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_basis.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/smooth/field_kernels.h"
#include "crowdface/smooth/principal_directions.h"

namespace crowdface {
namespace {

using FieldRows = RowArray<float>;

/// Truncation tolerance of the Chebyshev series of each node, as a fraction of the head's size. On
/// a head it is about 10⁻⁴ mm.
constexpr double kFieldSeriesTolerance = 1e-6;
/// Number of vertices at which the exact filter is recorded, to measure the error of the basis.
constexpr std::size_t kProbes = 1024;
/// Number of vertices from which the principal directions are computed.
constexpr std::size_t kSampleRows = 4096;
constexpr Index kTilesPerTask = 64;

/// Returns every n-th row of `count` rows, where n is the smallest number that leaves at most
/// `most` rows.
std::vector<std::uint32_t> strided_rows(std::size_t count, std::size_t most) {
  const std::size_t stride = (count + most - 1) / most;
  std::vector<std::uint32_t> rows;
  for (std::size_t r = 0; r < count; r += stride) rows.push_back(static_cast<std::uint32_t>(r));
  return rows;
}

/// Chooses the vertices (rows) from which the principal directions are computed. Half of the chosen
/// vertices are evenly spaced. For the other half, the function divides all vertices into blocks of
/// consecutive vertices. In each block, it chooses the vertex that smoothing to level 1 moves most,
/// because such a vertex is hard to fit with few fields.
NodeDisplacements sample_displacements(const std::vector<FieldRows>& displacements) {
  const FieldRows& first = displacements.front();
  const auto moved = [&](std::size_t r) {
    const float* d = first[r].value;
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  };
  std::vector<std::uint32_t> rows = strided_rows(first.size(), kSampleRows / 2);
  const std::size_t stretch = (first.size() + kSampleRows / 2 - 1) / (kSampleRows / 2);
  for (std::size_t begin = 0; begin < first.size(); begin += stretch) {
    std::size_t most = begin;
    for (std::size_t r = begin; r < std::min(begin + stretch, first.size()); ++r) {
      if (moved(r) > moved(most)) most = r;
    }
    rows.push_back(static_cast<std::uint32_t>(most));
  }
  NodeDisplacements sample;
  sample.node_count = static_cast<Index>(displacements.size());
  for (const std::uint32_t r : rows) {
    for (const FieldRows& node : displacements) {
      for (int c = 0; c < 3; ++c)
        sample.displacements.push_back(static_cast<double>(node[r].value[c]));
    }
  }
  return sample;
}

/// Chooses how many fields each tile of vertices keeps, and quantizes these fields.
class TileFitter {
 public:
  /// \param tolerance  largest allowed sum of truncation error and rounding error.
  TileFitter(const ChebyshevFilter& filter, const std::vector<FieldRows>& displacements,
             const PrincipalDirections& directions, double tolerance)
      : filter_(filter),
        displacements_(displacements),
        directions_(directions),
        count_(static_cast<std::size_t>(directions.level_functions.cols())),
        tolerance_(tolerance) {
    const Eigen::MatrixXd& functions = directions.level_functions;
    for (Index l = 0; l < functions.rows(); ++l) {
      for (Index p = 0; p < functions.cols(); ++p) {
        functions_.push_back(static_cast<float>(functions(l, p)));
      }
    }
    for (Index p = 0; p < functions.cols(); ++p) {
      max_magnitudes_.push_back(functions.col(p).cwiseAbs().maxCoeff());
    }
    for (Index n = 0; n < directions.field_coefficients.rows(); ++n) {
      for (Index p = 0; p < directions.field_coefficients.cols(); ++p) {
        field_coefficients_.push_back(static_cast<float>(directions.field_coefficients(n, p)));
      }
    }
  }

  /// The result of fitting consecutive tiles of vertices.
  struct FittedTiles {
    QuantizedTiles fields;  ///< for each tile: the leading vector fields that the tile stores
    /// largest distance of any vertex of the tiles, at any tested level, from its exact position
    double max_error = 0;
    /// index, in the list of tested levels, of the level at which `max_error` occurs
    std::size_t level = 0;
  };
  FittedTiles fit(Index first_tile, Index end_tile) const {
    FittedTiles fitted;
    std::vector<float> by_coordinate, by_vertex;
    for (Index tile = first_tile; tile < end_tile; ++tile) {
      combine(tile, by_coordinate, by_vertex);
      const auto of_field = [&](std::size_t p) {
        return std::span(std::as_const(by_vertex)).subspan(p * kTileValues, kTileValues);
      };
      // Omit trailing fields as long as the sum of their error bounds is negligible. This avoids
      // computing their error at each level.
      std::size_t significant_field_count = count_;
      double skipped = 0;
      for (; significant_field_count > 0; --significant_field_count) {
        const double more = max_magnitudes_[significant_field_count - 1] *
                            longest(of_field(significant_field_count - 1));
        if (skipped + more > kSkippedShare * tolerance_) break;
        skipped += more;
      }
      // rounding_bounds[p]: bound of the rounding error of the first p fields.
      std::vector<double> rounding_bounds = {0};
      for (std::size_t p = 0; p < significant_field_count; ++p) {
        const double half_a_step = 0.5 * static_cast<double>(quantization_step(of_field(p)));
        rounding_bounds.push_back(rounding_bounds.back() +
                                  max_magnitudes_[p] * std::sqrt(3.0) * half_a_step);
      }
      // Of the tile's significant fields, keep the fewest leading fields whose truncation error is
      // at most `max_truncation_error`.
      const double max_truncation_error =
          std::min(tolerance_ - rounding_bounds.back(), kTruncationShare * tolerance_) - skipped;
      const TruncationError left_out = choose_fewest_fields(
          by_coordinate.data(), significant_field_count, functions_.data(), count_,
          static_cast<std::size_t>(directions_.level_functions.rows()),
          max_truncation_error > 0 ? static_cast<float>(max_truncation_error * max_truncation_error)
                                   : 0.0F);
      fitted.fields.add(by_vertex, left_out.kept_fields);
      const double missed = std::sqrt(static_cast<double>(left_out.squared_error)) + skipped +
                            rounding_bounds[left_out.kept_fields];
      if (missed > fitted.max_error) {
        fitted.max_error = missed;
        fitted.level = left_out.level_index;
      }
    }
    return fitted;
  }

 private:
  /// The truncation error may use this fraction of the tolerance. Adjacent tiles keep different
  /// numbers of fields; with a larger fraction, a crease would be visible between the tiles. With
  /// 1/8, normals are as close to the exact normals as when all tiles keep the same fields
  /// (docs/method.md).
  static constexpr double kTruncationShare = 0.125;
  /// If the sum of the error bounds of trailing fields is at most this fraction of the tolerance,
  /// these fields are omitted, and their exact error at each level is not computed.
  static constexpr double kSkippedShare = 0.01;

  static double longest(std::span<const float> vectors) {
    float most = 0;
    for (std::size_t i = 0; i < vectors.size(); i += 3) {
      const float* v = &vectors[i];
      most = std::max(most, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return std::sqrt(static_cast<double>(most));
  }

  /// Computes the fields c_p at the tile's vertices for all p. Entries beyond the mesh's last
  /// vertex are zero.
  /// \param by_coordinate  receives #fields by 3 by kTileVertices.
  /// \param by_vertex      receives #fields by kTileVertices by 3.
  void combine(Index tile, std::vector<float>& by_coordinate, std::vector<float>& by_vertex) const {
    const std::size_t begin = static_cast<std::size_t>(tile) * kTileVertices;
    const std::size_t count =
        std::min(kTileVertices, static_cast<std::size_t>(filter_.vertex_count()) - begin);
    std::vector<Row<float>> in(count_ * kTileVertices), out(count_ * kTileVertices);
    std::vector<const Row<float>*> inputs;
    std::vector<Row<float>*> outputs;
    for (std::size_t n = 0; n < count_; ++n) {
      for (std::size_t i = 0; i < count; ++i) {
        in[n * kTileVertices + i] = displacements_[n][filter_.row_of_vertex()[begin + i]];
      }
      inputs.push_back(&in[n * kTileVertices]);
      outputs.push_back(&out[n * kTileVertices]);
    }
    combine_rows(inputs.data(), count_, field_coefficients_.data(), count_, count, outputs.data());
    by_coordinate.assign(count_ * kTileValues, 0.0F);
    by_vertex.assign(count_ * kTileValues, 0.0F);
    for (std::size_t p = 0; p < count_; ++p) {
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
          const float value = out[p * kTileVertices + i].value[c];
          by_coordinate[p * kTileValues + c * kTileVertices + i] = value;
          by_vertex[p * kTileValues + 3 * i + c] = value;
        }
      }
    }
  }

  const ChebyshevFilter& filter_;
  const std::vector<FieldRows>& displacements_;
  const PrincipalDirections& directions_;
  /// number of principal directions, which is the number of nodes of LevelNodes
  std::size_t count_;
  double tolerance_;
  /// #levels by #directions: the level function φ_p of each direction p (see LevelBasis) at each of
  /// the levels in directions_.level_functions
  std::vector<float> functions_;
  /// for each direction: largest absolute value of its level function over the levels of functions_
  std::vector<double> max_magnitudes_;
  std::vector<float> field_coefficients_;  ///< #nodes by #directions, see PrincipalDirections
};

/// The exact displacements at the probes, #levels by 3·#probes.
Columns exact_displacements(const RecordedTerms& probes, OperatorKind kind,
                            const std::vector<std::uint64_t>& levels) {
  Columns exact = Columns::Zero(static_cast<Index>(levels.size()), probes.terms.cols());
  parallel_for_each(exact.rows(), [&](std::ptrdiff_t l) {
    const ChebyshevSeries series = displacement_series(kind, levels[static_cast<std::size_t>(l)]);
    const auto terms = std::min(static_cast<Index>(series.size()), probes.terms.rows());
    for (Index k = 0; k < terms; ++k) {
      const double a = series[static_cast<std::size_t>(k)];
      if (a != 0) exact.row(l) += a * probes.terms.row(k);
    }
  });
  return exact;
}

struct ProbeError {
  double max = 0, rms = 0;
};

/// Compares fitted displacements Σ_p functions(l, p)·c_p with the exact displacements of the
/// filter, at all levels l and at the probes (some vertices). Returns the largest and the root mean
/// square distance between both.
/// \param field_at  field_at(probe, p, coordinate): the value of the vector field c_p.
template <class FieldAt>
ProbeError probe_error(const Columns& exact, const Eigen::MatrixXd& functions,
                       const FieldAt& field_at) {
  double sum = 0, most = 0;
  const Index probes = exact.cols() / 3;
  for (Index v = 0; v < probes; ++v) {
    for (Index l = 0; l < exact.rows(); ++l) {
      double squared = 0;
      for (Index c = 0; c < 3; ++c) {
        double value = 0;
        for (Index p = 0; p < functions.cols(); ++p) value += functions(l, p) * field_at(v, p, c);
        const double missed = value - exact(l, 3 * v + c);
        squared += missed * missed;
      }
      sum += squared;
      most = std::max(most, squared);
    }
  }
  return {std::sqrt(most), std::sqrt(sum / static_cast<double>(probes * exact.rows()))};
}

}  // namespace

std::vector<double> level_function_values(const LevelNodes& nodes,
                                          const Eigen::MatrixXd& coefficients,
                                          std::uint64_t level) {
  const std::vector<double> weights = nodes.interpolation_weights(level);
  std::vector<double> functions(static_cast<std::size_t>(coefficients.cols()), 0.0);
  for (Index p = 0; p < coefficients.cols(); ++p) {
    for (Index n = 0; n < coefficients.rows(); ++n) {
      functions[static_cast<std::size_t>(p)] +=
          weights[static_cast<std::size_t>(n)] * coefficients(n, p);
    }
  }
  return functions;
}

NodeFields filter_nodes(const ChebyshevFilter& filter, const LevelNodes& nodes,
                        const Positions& positions) {
  FilterInput<float> input;
  // Centre the head, because single-precision rounding depends on the position, but displacements
  // do not.
  const Eigen::RowVector3d middle =
      0.5 * (positions.colwise().minCoeff() + positions.colwise().maxCoeff());
  input.values = filter.rows_of<float>(positions.rowwise() - middle);
  for (const std::uint64_t level : nodes.levels()) {
    input.series.push_back(displacement_series(filter.kind(), level, kFieldSeriesTolerance));
  }
  NodeFields fields;
  for (const std::uint32_t r : strided_rows(input.values.size(), kProbes)) {
    fields.probe_terms.vertices.push_back(filter.vertex_of_row()[r]);
  }
  fields.displacements = std::move(filter.run<float>({&input, 1}, &fields.probe_terms).front());
  return fields;
}

LevelBasis fit_level_basis(const ChebyshevFilter& filter, const LevelNodes& nodes,
                           const NodeFields& node_fields, double tolerance) {
  const std::vector<FieldRows>& displacements = node_fields.displacements;
  const RecordedTerms& probes = node_fields.probe_terms;
  const TestedLevels tested = make_tested_levels(nodes);
  const Columns exact = exact_displacements(probes, filter.kind(), tested.levels);
  // Measure the error of interpolation between nodes. The fields may use the rest of the tolerance.
  const ProbeError of_nodes =
      probe_error(exact, tested.node_weights, [&](Index v, Index n, Index c) -> double {
        const std::uint32_t vertex = probes.vertices[static_cast<std::size_t>(v)];
        return displacements[static_cast<std::size_t>(n)][filter.row_of_vertex()[vertex]].value[c];
      });
  const double budget = tolerance - of_nodes.max;
  const PrincipalDirections directions =
      principal_directions(tested, sample_displacements(displacements), budget);
  const TileFitter fitter(filter, displacements, directions, budget);
  const auto tiles =
      static_cast<Index>(LevelFields::tile_count(static_cast<std::size_t>(filter.vertex_count())));
  std::vector<TileFitter::FittedTiles> parts(
      static_cast<std::size_t>((tiles + kTilesPerTask - 1) / kTilesPerTask));
  parallel_blocks(tiles, kTilesPerTask, [&](Index begin, Index end) {
    parts[static_cast<std::size_t>(begin / kTilesPerTask)] = fitter.fit(begin, end);
  });

  LevelBasis basis;
  basis.max_level = nodes.max_level();
  std::uint32_t rank = 0;
  std::vector<QuantizedTiles> fields;
  TileFitter::FittedTiles worst;
  for (TileFitter::FittedTiles& part : parts) {
    for (const std::uint32_t count : part.fields.field_counts) rank = std::max(rank, count);
    if (part.max_error > worst.max_error) worst = {{}, part.max_error, part.level};
    fields.push_back(std::move(part.fields));
  }
  basis.error.max = worst.max_error + of_nodes.max;
  if (basis.error.max > tolerance) {
    throw InvalidInput(concat("smoothing.tolerance: expected fitted smoothing levels within ",
                              tolerance, " of the exact levels (in file units), reached ",
                              basis.error.max, " with all ", nodes.levels().size(),
                              " fields; a larger tolerance or smoothing.levels: exact helps"));
  }
  basis.error.level = tested.levels[worst.level];
  basis.function_coefficients = directions.function_coefficients.leftCols(rank);
  basis.fields = concatenate(filter.vertex_count(), rank, std::move(fields));
  basis.error.rms =
      probe_error(exact, directions.level_functions.leftCols(rank), [&](Index v, Index p, Index c) {
        const auto vertex = static_cast<Index>(probes.vertices[static_cast<std::size_t>(v)]);
        return basis.fields.value(p, vertex, c);
      }).rms;
  return basis;
}

}  // namespace crowdface
