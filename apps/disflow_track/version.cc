// SPDX-License-Identifier: BSD-3-Clause
#include "version.h"

namespace disflow::apps {

// Each word is there because the code is, not because the build was told so.
std::string VersionText() {
  std::string text = "disflow_track " DISFLOW_VERSION " (" DISFLOW_BUILD ")\nwith: v4l2";
#ifdef DISFLOW_HAS_LIBCAMERA
  text += " libcamera";
#endif
  text += " serial udp mavlink";
#ifdef DISFLOW_HAS_DDS
  text += " dds";
#endif
#ifdef DISFLOW_HAS_ROSBAG
  text += " rosbag";
#endif
#ifdef DISFLOW_HAS_VIEW
  text += " view";
#endif
  return text + "\n";
}

}  // namespace disflow::apps
