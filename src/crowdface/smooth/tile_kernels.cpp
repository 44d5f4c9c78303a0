// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/tile_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/smooth/tile_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway requires foreach_target.h first, then the headers that are compiled once for each
// instruction set.
#include "crowdface/core/fused_lanes-inl.h"

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One step of the Chebyshev recurrence on one run of rows with equal valence.
/// \param kValence  number of neighbours of each row, known at compile time; 0: use run.valence.
template <std::uint32_t kValence, class T>
void step_run(const ValenceRun& run, const std::uint32_t* ring, T scale, const Row<T>* now,
              Row<T>* previous) {
  const hn::CappedTag<T, 4> lanes;
  const std::uint32_t valence = kValence == 0 ? run.valence : kValence;
  const auto factor = hn::Set(lanes, scale / static_cast<T>(valence));
  Row<T>* row = previous + run.first_row;
  for (const Row<T>* const end = row + run.row_count; row != end; ++row, ring += valence) {
    for (std::size_t l = 0; l < 4; l += hn::Lanes(lanes)) {
      auto sum = hn::Load(lanes, now[ring[0]].value + l);
      for (std::uint32_t n = 1; n < valence; ++n) {
        sum = hn::Add(sum, hn::Load(lanes, now[ring[n]].value + l));
      }
      const auto before = hn::Load(lanes, row->value + l);
      hn::Store(fused_multiply_subtract(factor, sum, before), lanes,
                row->value + l);  // Eq. 1 in the recurrence
    }
  }
}

template <class T>
void step(const ValenceRun* runs, std::size_t run_count, const std::uint32_t* neighbours, T scale,
          const Row<T>* now, Row<T>* previous) {
  for (const ValenceRun* run = runs; run != runs + run_count; ++run) {
    const std::uint32_t* ring = neighbours + run->first_neighbour;
    switch (run->valence) {
      case 4:
        step_run<4>(*run, ring, scale, now, previous);
        break;
      case 6:
        step_run<6>(*run, ring, scale, now, previous);
        break;
      default:
        step_run<0>(*run, ring, scale, now, previous);
    }
  }
}

template <class T>
void add_scaled_rows(T factor, const Row<T>* values, std::size_t count, Row<T>* sums) {
  const hn::CappedTag<T, 8> lanes;  // two rows per iteration
  const auto a = hn::Set(lanes, factor);
  const T* value = values->value;
  T* sum = sums->value;
  const T* const end = sum + 4 * (count / 2 * 2);
  for (; sum != end; sum += 8, value += 8) {
    for (std::size_t l = 0; l < 8; l += hn::Lanes(lanes)) {
      const auto added =
          fused_multiply_add(a, hn::LoadU(lanes, value + l), hn::LoadU(lanes, sum + l));
      hn::StoreU(added, lanes, sum + l);
    }
  }
  if (count % 2 != 0) {
    const hn::CappedTag<T, 4> four;
    for (std::size_t l = 0; l < 4; l += hn::Lanes(four)) {
      const auto added = fused_multiply_add(hn::Set(four, factor), hn::LoadU(four, value + l),
                                            hn::LoadU(four, sum + l));
      hn::StoreU(added, four, sum + l);
    }
  }
}

/// Returns consecutive rows as one array of numbers, four per row.
inline const float* values_of(const Row<float>* rows) {
  return reinterpret_cast<const float*>(rows);
}
inline float* values_of(Row<float>* rows) {
  return reinterpret_cast<float*>(rows);
}

/// Computes #lanes consecutive numbers, from index `begin` on, of each output from `first` to
/// `first` + kOutputs − 1. Computing several outputs at a time hides the latency of additions.
template <std::size_t kOutputs, class Lanes>
void combine_some(Lanes lanes, const Row<float>* const* inputs, std::size_t input_count,
                  const float* factors, std::size_t output_count, std::size_t first,
                  std::size_t begin, Row<float>* const* outputs) {
  hn::VFromD<Lanes> sums[kOutputs];
  for (auto& sum : sums) sum = hn::Zero(lanes);
  for (std::size_t n = 0; n < input_count; ++n) {
    const auto value = hn::LoadU(lanes, values_of(inputs[n]) + begin);
    const float* factor = factors + n * output_count + first;
    for (std::size_t o = 0; o < kOutputs; ++o) {
      sums[o] = fused_multiply_add(hn::Set(lanes, factor[o]), value, sums[o]);
    }
  }
  for (std::size_t o = 0; o < kOutputs; ++o) {
    hn::StoreU(sums[o], lanes, values_of(outputs[first + o]) + begin);
  }
}

template <class Lanes>
void combine_values(Lanes lanes, const Row<float>* const* inputs, std::size_t input_count,
                    const float* factors, std::size_t output_count, std::size_t begin,
                    Row<float>* const* outputs) {
  std::size_t first = 0;
  for (; first + 8 <= output_count; first += 8) {
    combine_some<8>(lanes, inputs, input_count, factors, output_count, first, begin, outputs);
  }
  for (; first < output_count; ++first) {
    combine_some<1>(lanes, inputs, input_count, factors, output_count, first, begin, outputs);
  }
}

void combine(const Row<float>* const* inputs, std::size_t input_count, const float* factors,
             std::size_t output_count, std::size_t count, Row<float>* const* outputs) {
  const hn::CappedTag<float, 8> lanes;
  const hn::CappedTag<float, 4> four;
  std::size_t begin = 0;
  for (; begin + hn::Lanes(lanes) <= 4 * count; begin += hn::Lanes(lanes)) {
    combine_values(lanes, inputs, input_count, factors, output_count, begin, outputs);
  }
  for (; begin < 4 * count; begin += hn::Lanes(four)) {
    combine_values(four, inputs, input_count, factors, output_count, begin, outputs);
  }
}

// These functions are not templates because Highway's dispatch table does not support templates.
void step_float(const ValenceRun* runs, std::size_t run_count, const std::uint32_t* neighbours,
                float scale, const Row<float>* now, Row<float>* previous) {
  step(runs, run_count, neighbours, scale, now, previous);
}
void step_double(const ValenceRun* runs, std::size_t run_count, const std::uint32_t* neighbours,
                 double scale, const Row<double>* now, Row<double>* previous) {
  step(runs, run_count, neighbours, scale, now, previous);
}
void add_scaled_float(float factor, const Row<float>* values, std::size_t count, Row<float>* sums) {
  add_scaled_rows(factor, values, count, sums);
}
void add_scaled_double(double factor, const Row<double>* values, std::size_t count,
                       Row<double>* sums) {
  add_scaled_rows(factor, values, count, sums);
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(step_float);
HWY_EXPORT(step_double);
HWY_EXPORT(add_scaled_float);
HWY_EXPORT(add_scaled_double);
HWY_EXPORT(combine);

template <>
void recurrence_step(const ValenceRun* runs, std::size_t run_count, const std::uint32_t* neighbours,
                     float scale, const Row<float>* now, Row<float>* previous) {
  HWY_DYNAMIC_DISPATCH(step_float)(runs, run_count, neighbours, scale, now, previous);
}
template <>
void recurrence_step(const ValenceRun* runs, std::size_t run_count, const std::uint32_t* neighbours,
                     double scale, const Row<double>* now, Row<double>* previous) {
  HWY_DYNAMIC_DISPATCH(step_double)(runs, run_count, neighbours, scale, now, previous);
}
template <>
void add_scaled(float factor, const Row<float>* values, std::size_t count, Row<float>* sums) {
  HWY_DYNAMIC_DISPATCH(add_scaled_float)(factor, values, count, sums);
}
template <>
void add_scaled(double factor, const Row<double>* values, std::size_t count, Row<double>* sums) {
  HWY_DYNAMIC_DISPATCH(add_scaled_double)(factor, values, count, sums);
}

void combine_rows(const Row<float>* const* inputs, std::size_t input_count, const float* factors,
                  std::size_t output_count, std::size_t count, Row<float>* const* outputs) {
  HWY_DYNAMIC_DISPATCH(combine)(inputs, input_count, factors, output_count, count, outputs);
}

}  // namespace crowdface
#endif
