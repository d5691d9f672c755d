// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "disflow/field/packed_direction.h"
#include "disflow/memory/fixed_point.h"
#include "disflow/memory/packed_variance.h"
#include "disflow/types.h"

namespace disflow {

/// A surface sample of the model: the running average of the observations near it.
struct ModelSample {
  Vec3 position_m;
  Vec3 normal;
  float variance_m2;      ///< Of the position along the normal.
  float normal_variance;  ///< Per tangential component [rad^2].
  std::uint16_t observations;
};

/// At most kMaxSamples samples within a bounded reach of a place, 16 bytes each. Samples go in and
/// come out by value: positions are rounded to 1/32767 of the reach, normals to 6e-5 rad, variances
/// to 0.05 %. Start() it before first use.
template <int kMaxSamples>
class SampleList {
 public:
  /// Forgets all samples.
  /// @param reach_m Positions farther than this from the origin along an axis are moved back to it.
  void Start(const Vec3& origin_m, float reach_m) noexcept {
    origin_m_ = origin_m;
    step_m_ = reach_m / kMostSteps;
    size_ = 0;
  }

  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] bool full() const noexcept { return size_ == kMaxSamples; }

  [[nodiscard]] Vec3 position_m(int i) const noexcept {
    const auto& steps = at(i).position;
    return origin_m_ + step_m_ * Vec3(static_cast<float>(steps[0]), static_cast<float>(steps[1]),
                                      static_cast<float>(steps[2]));
  }
  [[nodiscard]] ModelSample operator[](int i) const noexcept {
    const Packed& packed = at(i);
    return {position_m(i), packed.normal.direction(), packed.variance_m2.value(),
            packed.normal_variance.value(), packed.observations};
  }

  /// @return false when full; the list is then unchanged.
  [[nodiscard]] bool push_back(const ModelSample& sample) noexcept {
    if (full()) return false;
    ++size_;
    Set(size_ - 1, sample);
    return true;
  }
  void Set(int i, const ModelSample& sample) noexcept {
    assert(i >= 0 && i < size_);
    const Vec3 steps = (sample.position_m - origin_m_) / step_m_;
    samples_[static_cast<std::size_t>(i)] = {
        {RoundToSteps(steps.x()), RoundToSteps(steps.y()), RoundToSteps(steps.z())},
        PackedVariance(sample.variance_m2),
        PackedDirection(sample.normal),
        PackedVariance(sample.normal_variance),
        sample.observations};
  }

  /// Reads the samples one after the other.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = ModelSample;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = ModelSample;

    Iterator(const SampleList& list, int i) noexcept : list_(&list), i_(i) {}
    [[nodiscard]] ModelSample operator*() const noexcept { return (*list_)[i_]; }
    Iterator& operator++() noexcept {
      ++i_;
      return *this;
    }
    Iterator operator++(int) noexcept { return {*list_, i_++}; }
    [[nodiscard]] bool operator==(const Iterator& other) const noexcept { return i_ == other.i_; }

   private:
    const SampleList* list_;
    int i_;
  };
  [[nodiscard]] Iterator begin() const noexcept { return {*this, 0}; }
  [[nodiscard]] Iterator end() const noexcept { return {*this, size_}; }

 private:
  struct Packed {
    std::array<std::int16_t, 3> position;
    PackedVariance variance_m2;
    PackedDirection normal;
    PackedVariance normal_variance;
    std::uint16_t observations;
  };
  static_assert(sizeof(Packed) == 16);

  [[nodiscard]] const Packed& at(int i) const noexcept {
    assert(i >= 0 && i < size_);
    return samples_[static_cast<std::size_t>(i)];
  }

  Vec3 origin_m_;
  float step_m_;
  int size_ = 0;
  std::array<Packed, static_cast<std::size_t>(kMaxSamples)> samples_;
};

}  // namespace disflow
