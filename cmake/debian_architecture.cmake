# SPDX-License-Identifier: BSD-3-Clause
# disflow_debian_architecture: what Debian calls the processor that is built for.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")
  set(disflow_debian_architecture amd64)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  set(disflow_debian_architecture arm64)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^arm")
  set(disflow_debian_architecture armhf)
else()
  set(disflow_debian_architecture ${CMAKE_SYSTEM_PROCESSOR})
endif()
