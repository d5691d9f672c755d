// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace disflow::apps {

struct ViewOptions {
  std::string address;  ///< Empty: no view.
  std::string token;    ///< Empty: a new one, unless the address says `token=none`.
  bool hold = false;    ///< The page stays after the input's end.
};

void AddViewOptions(CLI::App& app, ViewOptions& options);

}  // namespace disflow::apps
