// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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
/// come out by value: positions are rounded to 1/32767 of the reach, normals to 7e-5 rad, variances
/// to 0.05 %. Start() it before first use.
template <int kMaxSamples>
class SampleList {
 public:
  /// Forgets all samples.
  /// @param reach_m Positions farther than this from the origin along an axis are moved back to it.
  void Start(const Vec3& origin_m, float reach_m) noexcept {
    origin_m_ = origin_m;
    step_m_ = reach_m / kMostSteps;
    for (auto& axis : position_) axis.fill(0);
    size_ = 0;
  }

  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] bool full() const noexcept { return size_ == kMaxSamples; }

  [[nodiscard]] Vec3 position_m(int i) const noexcept {
    assert(i >= 0 && i < size_);
    const auto k = static_cast<std::size_t>(i);
    return origin_m_ + step_m_ * Vec3(static_cast<float>(position_[0][k]),
                                      static_cast<float>(position_[1][k]),
                                      static_cast<float>(position_[2][k]));
  }
  [[nodiscard]] int observations(int i) const noexcept { return rest(i).observations; }
  /// Of the sample that was observed most often; 0 if there is none.
  [[nodiscard]] int MostObservations() const noexcept {
    int most = 0;
    for (int i = 0; i < size_; ++i) most = std::max(most, observations(i));
    return most;
  }
  [[nodiscard]] float variance_m2(int i) const noexcept { return rest(i).variance_m2.value(); }
  [[nodiscard]] Vec3 normal(int i) const noexcept { return rest(i).normal.direction(); }
  [[nodiscard]] ModelSample operator[](int i) const noexcept {
    const Rest& r = rest(i);
    return {position_m(i), r.normal.direction(), r.variance_m2.value(), r.normal_variance.value(),
            r.observations};
  }

  using Distances = std::array<float, static_cast<std::size_t>(kMaxSamples)>;

  /// Squared distances from x to the samples. Elements from size() on have no meaning.
  [[nodiscard]] Distances SquaredDistances(const Vec3& x_m) const noexcept {
    return Measure(x_m, [](float x, float y, float z) { return x * x + y * y + z * z; });
  }
  /// The same, measured across a direction of unit length.
  [[nodiscard]] Distances SquaredDistancesAcross(const Vec3& x_m,
                                                 const Vec3& direction) const noexcept {
    return Measure(x_m, [&direction](float x, float y, float z) {
      const float along = x * direction.x() + y * direction.y() + z * direction.z();
      return x * x + y * y + z * z - along * along;
    });
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
    const auto k = static_cast<std::size_t>(i);
    const Vec3 steps = (sample.position_m - origin_m_) / step_m_;
    for (int axis = 0; axis < 3; ++axis)
      position_[static_cast<std::size_t>(axis)][k] = RoundToSteps(steps[axis]);
    rest_[k] = {PackedVariance(sample.variance_m2), PackedDirection(sample.normal),
                PackedVariance(sample.normal_variance), sample.observations};
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
  static constexpr int kGroup = 4;
  static_assert(kMaxSamples % kGroup == 0);
  using Steps = std::array<std::int16_t, static_cast<std::size_t>(kMaxSamples)>;

  /// All of a sample but its position.
  struct Rest {
    PackedVariance variance_m2;
    PackedDirection normal;
    PackedVariance normal_variance;
    std::uint16_t observations;
  };
  static_assert(sizeof(Rest) == 10);

  /// measure(x, y, z) of the offsets from the samples to a point.
  template <class Function>
  [[nodiscard]] Distances Measure(const Vec3& x_m, Function&& measure) const noexcept {
    Distances result;
    const Vec3 offset_m = x_m - origin_m_;
    // In whole groups, for vector instructions.
    const auto count = static_cast<std::size_t>((size_ + kGroup - 1) / kGroup * kGroup);
    for (std::size_t i = 0; i < count; ++i) {
      result[i] = measure(offset_m.x() - step_m_ * static_cast<float>(position_[0][i]),
                          offset_m.y() - step_m_ * static_cast<float>(position_[1][i]),
                          offset_m.z() - step_m_ * static_cast<float>(position_[2][i]));
    }
    return result;
  }

  [[nodiscard]] const Rest& rest(int i) const noexcept {
    assert(i >= 0 && i < size_);
    return rest_[static_cast<std::size_t>(i)];
  }

  Vec3 origin_m_;
  float step_m_;
  int size_ = 0;
  std::array<Steps, 3> position_;  ///< From the origin, per axis.
  std::array<Rest, static_cast<std::size_t>(kMaxSamples)> rest_;
};

}  // namespace disflow
