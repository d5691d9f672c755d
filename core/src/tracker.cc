// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/tracker_impl.h"

namespace disflow {

template class Tracker<profiles::Micro>;
template class Tracker<profiles::Edge>;
template class Tracker<profiles::Dense>;

}  // namespace disflow
