// SPDX-License-Identifier: BSD-3-Clause
#include "settings/view_options.h"

#include <CLI/CLI.hpp>

namespace disflow::apps {

void AddViewOptions(CLI::App& app, ViewOptions& options) {
  app.add_option("--view", options.address,
                 "Show the run live in browsers, on this machine's port or, with a token, for "
                 "others: 0.0.0.0:8080 (docs/view.md)")
      ->type_name("[ADDRESS]:PORT");
  app.add_option("--view-token", options.token,
                 "What a browser has to know to see the page and to use its buttons [none on this "
                 "machine, else a new one that is printed]")
      ->envname("DISFLOW_VIEW_TOKEN")
      ->type_name("TEXT");
  app.add_flag("--view-hold", options.hold,
               "Keep the page after the end of the input, until Ctrl-C");
}

}  // namespace disflow::apps
