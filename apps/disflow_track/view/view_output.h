// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>

#include "objects/object_channel.h"
#include "program/console.h"
#include "settings/view_options.h"

namespace disflow::apps {

class LiveView;

/// The page on which browsers see the run, if it is asked for; see docs/view.md.
class ViewOutput {
 public:
  /// Says where the page is.
  /// @param channels Outlive the view. Before the run starts.
  /// @throws Failure kWrongUsage, also if the program was built without it; kOutputFailed.
  ViewOutput(const ViewOptions& options, std::span<ObjectChannel* const> channels,
             Console& console);
  ViewOutput(const ViewOutput&) = delete;
  ViewOutput& operator=(const ViewOutput&) = delete;
  ~ViewOutput();

  /// The page says that the input has ended. Returns at once, or when the program is asked to stop
  /// if the page shall stay.
  void EndOfInput();

 private:
  bool hold_;
  Console& console_;
  std::unique_ptr<LiveView> view_;  ///< Null: not asked for.
};

}  // namespace disflow::apps
