// SPDX-License-Identifier: BSD-3-Clause
#include "settings/view_options.h"

#include <CLI/CLI.hpp>

namespace disflow::apps {

void AddViewOptions(CLI::App& app, ViewOptions& options) {
  app.add_option("--view", options.address,
                 "Show the run live in browsers, on this machine's port or for others: "
                 "0.0.0.0:8080; needs a token, unless :8080?token=none says that whoever uses "
                 "this machine may look (docs/view.md)")
      ->type_name("[ADDRESS]:PORT[?token=none]");
  app.add_option("--view-token", options.token,
                 "What a browser has to know to see the page and to use its buttons [a new "
                 "one for each run, printed with the address]")
      ->envname("DISFLOW_VIEW_TOKEN")
      ->type_name("TEXT");
  app.add_flag("--view-hold", options.hold,
               "Keep the page after the end of the input, until Ctrl-C");
}

}  // namespace disflow::apps
