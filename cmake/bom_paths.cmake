# SPDX-License-Identifier: BSD-3-Clause
# For bom.cmake and its tests, which are read before it.
set(disflow_bom_settings ${PROJECT_BINARY_DIR}/bom_settings.cmake)
