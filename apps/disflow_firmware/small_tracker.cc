// SPDX-License-Identifier: BSD-3-Clause
// The library has the shipped profiles only.
#include "disflow/tracker_impl.h"
#include "profile.h"

namespace disflow {

static_assert(sizeof(Tracker<firmware::Small>) <= 256U * 1024U);
template class Tracker<firmware::Small>;

}  // namespace disflow
