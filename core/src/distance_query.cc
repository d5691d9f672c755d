// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/distance_query.h"

namespace disflow {

template class DistanceQuerier<profiles::Micro>;
template class DistanceQuerier<profiles::Edge>;
template class DistanceQuerier<profiles::Dense>;

}  // namespace disflow
