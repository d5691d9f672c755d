# SPDX-License-Identifier: BSD-3-Clause
set(disflow_bom_components "")

# disflow_bom(<name> <licence> <use> <Debian package>): use is "compiled in" or "linked".
macro(disflow_bom name licence use package)
  list(APPEND disflow_bom_components "${name}|${licence}|${use}|${package}")
endmacro()
