// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/tracker.h"
