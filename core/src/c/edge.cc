// SPDX-License-Identifier: BSD-3-Clause
#include "profile_binding.h"

// A file of its own, so that a program which does not name the profile does not get its code.
const disflow_profile disflow_edge =
    disflow::c::MakeProfile<disflow::profiles::Edge, DISFLOW_EDGE_BYTES>();
