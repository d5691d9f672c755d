// SPDX-License-Identifier: BSD-3-Clause
// Something to compile for the target that holds the precompiled headers of the programs.
