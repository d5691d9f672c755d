// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/tracker_impl.h"

namespace disflow {

// Budgets: docs/memory.md says what they are spent on.
static_assert(sizeof(Tracker<profiles::Micro>) <= 400U * 1024U);
static_assert(sizeof(Tracker<profiles::Edge>) <= 1280U * 1024U);
static_assert(sizeof(Tracker<profiles::Dense>) <= 11U * 1024U * 1024U);

template class Tracker<profiles::Micro>;
template class Tracker<profiles::Edge>;
template class Tracker<profiles::Dense>;

}  // namespace disflow
