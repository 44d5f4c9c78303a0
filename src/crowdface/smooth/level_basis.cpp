// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_basis.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/smooth/principal_directions.h"

namespace crowdface {
namespace {

using FieldRows = RowArray<float>;

/// A level's displacement may miss this share of the head's size to the end of its series: some
/// 10⁻⁴ mm.
constexpr double kFieldSeriesTolerance = 1e-6;
/// Vertices at which the filter itself is kept, to hold the basis against.
constexpr std::size_t kProbes = 1024;
/// Vertices that choose the principal directions and the rank; the error is then measured at all.
constexpr std::size_t kSampleRows = 4096;
constexpr Index kMeasureBlock = 256;
/// Of the tolerance, what 16 bits may round away.
constexpr double kRoundingShare = 0.05;

/// Every n-th of `count` rows, `most` at most.
std::vector<std::uint32_t> strided_rows(std::size_t count, std::size_t most) {
  const std::size_t stride = (count + most - 1) / most;
  std::vector<std::uint32_t> rows;
  for (std::size_t r = 0; r < count; r += stride) rows.push_back(static_cast<std::uint32_t>(r));
  return rows;
}

/// The rows that choose the directions: some evenly spread, and from each stretch the one that
/// moves most in the first iteration, since that is where few fields fit worst.
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
  sample.nodes = static_cast<Index>(displacements.size());
  for (const std::uint32_t r : rows) {
    for (const FieldRows& node : displacements) {
      for (int c = 0; c < 3; ++c) sample.values.push_back(static_cast<double>(node[r].value[c]));
    }
  }
  return sample;
}

/// c_p of the rows [begin, end) for all p, computed from the nodes' displacements.
class CombinedRows {
 public:
  CombinedRows(const std::vector<FieldRows>& displacements, const Eigen::MatrixXd& combining)
      : displacements_(displacements), outputs_(static_cast<std::size_t>(combining.cols())) {
    for (Index n = 0; n < combining.rows(); ++n) {
      for (Index p = 0; p < combining.cols(); ++p) {
        factors_.push_back(static_cast<float>(combining(n, p)));
      }
    }
  }

  void compute(std::size_t begin, std::size_t end) {
    std::vector<const Row<float>*> inputs;
    for (const FieldRows& rows : displacements_) inputs.push_back(rows.data() + begin);
    std::vector<Row<float>*> outputs;
    for (std::vector<Row<float>>& rows : outputs_) {
      rows.resize(end - begin);
      outputs.push_back(rows.data());
    }
    combine_rows(inputs.data(), inputs.size(), factors_.data(), outputs.size(), end - begin,
                 outputs.data());
  }

  /// c_p of row begin + i.
  const float* at(Index p, std::size_t i) const {
    return outputs_[static_cast<std::size_t>(p)][i].value;
  }

 private:
  const std::vector<FieldRows>& displacements_;
  std::vector<float> factors_;
  std::vector<std::vector<Row<float>>> outputs_;
};

/// The largest distance that something misses, and at which tested level.
struct Worst {
  double squared = 0;
  Index level = 0;
  void see(double squared_distance, Index at) {
    if (squared_distance > squared || (squared_distance == squared && at < level)) {
      squared = squared_distance;
      level = at;
    }
  }
};

/// What the directions from `rank` on contribute to one vertex, over all tested levels.
Worst worst_missed(const Directions& directions, const CombinedRows& fields, std::size_t row,
                   Index rank) {
  Worst worst;
  for (Index l = 0; l < directions.functions.rows(); ++l) {
    double missed[3] = {};
    for (Index p = rank; p < directions.functions.cols(); ++p) {
      const float* c = fields.at(p, row);
      for (int i = 0; i < 3; ++i)
        missed[i] += directions.functions(l, p) * static_cast<double>(c[i]);
    }
    worst.see(missed[0] * missed[0] + missed[1] * missed[1] + missed[2] * missed[2], l);
  }
  return worst;
}

/// Writes the fields of the first `rank` directions in the order of vertices, and measures what the
/// others would have added, at every vertex; gives up as soon as that exceeds the budget.
Worst write_fields(const ChebyshevFilter& filter, const Directions& directions,
                   const std::vector<FieldRows>& displacements, Index rank, double budget,
                   std::vector<float>& fields) {
  const Index nodes = directions.functions.cols(), vertices = filter.vertex_count();
  std::vector<double> peak;  // of |φ_p| over the levels
  for (Index p = 0; p < nodes; ++p) {
    peak.push_back(directions.functions.col(p).cwiseAbs().maxCoeff());
  }
  fields.resize(static_cast<std::size_t>(3 * rank * vertices));
  Worst worst;  // what the sample knows spares looking closely at most vertices
  const double known = directions.missed.col(rank).maxCoeff(&worst.level);
  const Index worst_of_sample = worst.level;
  worst.squared = known * known;
  std::mutex mutex;
  std::atomic<bool> too_few = false;
  parallel_blocks(vertices, kMeasureBlock, [&](Index begin, Index end) {
    if (too_few) return;
    CombinedRows rows(displacements, directions.combining);
    rows.compute(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
    Worst mine{known * known, worst_of_sample};
    for (Index r = begin; r < end; ++r) {
      const auto local = static_cast<std::size_t>(r - begin);
      const Index vertex = filter.vertex_of_row()[static_cast<std::size_t>(r)];
      for (Index p = 0; p < rank; ++p) {
        std::copy_n(rows.at(p, local), 3, fields.data() + 3 * (p * vertices + vertex));
      }
      double bound = 0;
      for (Index p = rank; p < nodes; ++p) {
        const float* c = rows.at(p, local);
        bound += peak[static_cast<std::size_t>(p)] *
                 std::sqrt(static_cast<double>(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]));
      }
      if (bound * bound < mine.squared) continue;  // cannot be the worst
      const Worst here = worst_missed(directions, rows, local, rank);
      mine.see(here.squared, here.level);
    }
    const std::lock_guard lock(mutex);
    worst.see(mine.squared, mine.level);
    if (worst.squared > budget * budget) too_few = true;
  });
  return worst;
}

/// The filter's own displacements at the probes, #levels by 3·#probes.
Columns exact_displacements(const Probes& probes, OperatorKind kind,
                            const std::vector<std::uint64_t>& levels) {
  Columns exact = Columns::Zero(static_cast<Index>(levels.size()), probes.values.cols());
  parallel_for_each(exact.rows(), [&](std::ptrdiff_t l) {
    const ChebyshevSeries series = displacement_series(kind, levels[static_cast<std::size_t>(l)]);
    const auto terms = std::min(static_cast<Index>(series.size()), probes.values.rows());
    for (Index k = 0; k < terms; ++k) {
      const double a = series[static_cast<std::size_t>(k)];
      if (a != 0) exact.row(l) += a * probes.values.row(k);
    }
  });
  return exact;
}

struct ProbeError {
  double max = 0, rms = 0;
};

/// How far Σ_p functions(l, p) fields_p is from the filter at the probes.
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

/// How far each field, rounded to whole steps, may take a vertex away: √3 times half a step in each
/// coordinate, at the level that uses it most.
std::vector<double> rounding_of(const LevelFields& fields, const Eigen::MatrixXd& functions) {
  std::vector<double> rounding;
  for (Index p = 0; p < functions.cols(); ++p) {
    rounding.push_back(functions.col(p).cwiseAbs().maxCoeff() * std::sqrt(0.75) *
                       fields.steps[static_cast<std::size_t>(p)]);
  }
  return rounding;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The fields in 16 bits. Where that rounds away more than it may, what is left of the fields that lose most
/// becomes fields of their own, with the same functions.
/// \param fields     #columns by #V by 3
/// \param functions  #levels by #columns, and columns of the mixing likewise; grow with the fields.
/// \return what may be rounded away.
double round_fields(std::vector<float>& fields, double most, Index vertex_count,
                    Eigen::MatrixXd& functions, Eigen::MatrixXd& mixing, LevelFields& rounded) {
  rounded = in_16_bits(fields, vertex_count);
  std::vector<double> rounding = rounding_of(rounded, functions);
  std::vector<Index> lossy;
  for (double left = sum_of(rounding); left > most;) {
    const auto worst = std::max_element(rounding.begin(), rounding.end());
    left -= *worst;
    *worst = 0;
    lossy.push_back(worst - rounding.begin());
  }
  if (lossy.empty()) return sum_of(rounding);
  for (const Index p : lossy) {
    for (Index v = 0; v < vertex_count; ++v) {
      for (Index c = 0; c < 3; ++c) {
        const float value = fields[static_cast<std::size_t>(3 * (p * vertex_count + v) + c)];
        fields.push_back(static_cast<float>(static_cast<double>(value) - rounded.value(p, v, c)));
      }
    }
    for (Eigen::MatrixXd* matrix : {&functions, &mixing}) {
      matrix->conservativeResize(Eigen::NoChange, matrix->cols() + 1);
      matrix->rightCols(1) = matrix->col(p);
    }
  }
  rounded = in_16_bits(fields, vertex_count);
  std::vector<double> left = rounding_of(rounded, functions);
  for (const Index p : lossy) left[static_cast<std::size_t>(p)] = 0;
  return sum_of(left);
}

}  // namespace

std::vector<double> basis_functions(const LevelNodes& nodes, const Eigen::MatrixXd& mixing,
                                    std::uint64_t level) {
  const std::vector<double> weights = nodes.weights(level);
  std::vector<double> functions(static_cast<std::size_t>(mixing.cols()), 0.0);
  for (Index p = 0; p < mixing.cols(); ++p) {
    for (Index n = 0; n < mixing.rows(); ++n) {
      functions[static_cast<std::size_t>(p)] += weights[static_cast<std::size_t>(n)] * mixing(n, p);
    }
  }
  return functions;
}

NodeFields filter_nodes(const ChebyshevFilter& filter, const LevelNodes& nodes,
                        const Positions& positions) {
  FilterInput<float> input;
  // Displacements do not depend on where the head stands, but rounding does.
  const Eigen::RowVector3d middle =
      0.5 * (positions.colwise().minCoeff() + positions.colwise().maxCoeff());
  input.values = filter.rows_of<float>(positions.rowwise() - middle);
  for (const std::uint64_t level : nodes.levels()) {
    input.series.push_back(displacement_series(filter.kind(), level, kFieldSeriesTolerance));
  }
  NodeFields fields;
  for (const std::uint32_t r : strided_rows(input.values.size(), kProbes)) {
    fields.probes.vertices.push_back(filter.vertex_of_row()[r]);
  }
  fields.displacements = std::move(filter.run<float>({&input, 1}, &fields.probes).front());
  return fields;
}

LevelBasis fit_level_basis(const ChebyshevFilter& filter, const LevelNodes& nodes,
                           const NodeFields& node_fields, double tolerance) {
  const std::vector<FieldRows>& displacements = node_fields.displacements;
  const Probes& probes = node_fields.probes;
  const TestedLevels tested = test_levels(nodes);
  const Columns exact = exact_displacements(probes, filter.kind(), tested.levels);
  const ProbeError of_nodes =
      probe_error(exact, tested.weights, [&](Index v, Index n, Index c) -> double {
        const std::uint32_t vertex = probes.vertices[static_cast<std::size_t>(v)];
        return displacements[static_cast<std::size_t>(n)][filter.row_of_vertex()[vertex]].value[c];
      });
  const double rounding = kRoundingShare * tolerance;
  const double budget = tolerance - of_nodes.max - rounding;
  constexpr double kMargin = 0.9;  // for vertices beside the sample
  const Directions directions =
      principal_directions(tested, sample_displacements(displacements), kMargin * budget);

  LevelBasis basis;
  basis.max_level = nodes.max_level();
  std::vector<float> fields;
  for (Index rank = directions.rank; rank <= directions.mixing.cols(); ++rank) {
    const Worst worst = write_fields(filter, directions, displacements, rank, budget, fields);
    if (std::sqrt(worst.squared) > budget) continue;  // a vertex beside the sample is worse
    Eigen::MatrixXd functions = directions.functions.leftCols(rank);
    basis.mixing = directions.mixing.leftCols(rank);
    const double rounded = round_fields(fields, rounding, filter.vertex_count(), functions,
                                        basis.mixing, basis.fields);
    basis.error.max = std::sqrt(worst.squared) + of_nodes.max + rounded;
    basis.error.level = tested.levels[static_cast<std::size_t>(worst.level)];
    basis.error.rms = probe_error(exact, functions, [&](Index v, Index p, Index c) {
                        const auto vertex =
                            static_cast<Index>(probes.vertices[static_cast<std::size_t>(v)]);
                        return basis.fields.value(p, vertex, c);
                      }).rms;
    return basis;
  }
  throw InvalidInput(concat("expected levels within ", tolerance, ", reached ", of_nodes.max,
                            " with ", nodes.levels().size(), " fields"));
}

}  // namespace crowdface
