// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/gp_workspace.h"

namespace disflow {

bool IsUsable(const GpTrainingSample& sample) noexcept {
  return sample.position_m.allFinite() && sample.value_variance_m2 >= 0.0F &&
         sample.normal_variance >= 0.0F && std::isfinite(sample.value_variance_m2) &&
         std::isfinite(sample.normal_variance);
}

}  // namespace disflow
