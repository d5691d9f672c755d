// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "disflow/config_fields.h"
#include "settings/refusal.h"
#include "settings/settings.h"

namespace disflow::apps {
namespace {

std::string Literal(int value) { return std::to_string(value); }

/// The fewest digits that give the same float again, in TOML's syntax for floating-point numbers.
std::string Literal(float value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  (void)error;  // 32 characters hold every float
  std::string literal(text.data(), end);
  if (literal.find_first_of(".e") == std::string::npos) literal += ".0";
  return literal;
}

/// "field.cell_size_m" is key cell_size_m of section field.
struct SettingName {
  explicit SettingName(std::string_view dotted)
      : section(dotted.substr(0, dotted.find('.'))), key(dotted.substr(dotted.find('.') + 1)) {}
  std::string_view section;
  std::string_view key;
};

}  // namespace

std::string FormatSettings(const Config& config) {
  std::string text = "# Settings of disflow_track; give this file with --config.\n";
  std::string_view section;
  VisitFields(config, [&](const auto& field) {
    const SettingName name(field.name);
    if (name.section != section) {
      section = name.section;
      text.append("\n[").append(section).append("]\n");
    }
    text.append("# ").append(field.meaning);
    text.append("\n# unit ").append(field.unit);
    text.append(", ").append(NumberText(field.min)).append(" to ").append(NumberText(field.max));
    text.append("\n").append(name.key).append(" = ").append(Literal(field.value)).append("\n");
  });
  return text;
}

std::string FormatSettingsPage() {
  std::string text =
      "<!-- SPDX-License-Identifier: BSD-3-Clause -->\n"
      "# Settings\n"
      "\n"
      "What may change between runs. `disflow_track --print-config > run.toml` writes a file with\n"
      "all of them, `--config run.toml` reads it, `--set registration.iterations=10` changes one.\n"
      "What is marked with \u2713 may also change while the program runs: by SIGHUP, which reads "
      "the\n"
      "file again ([deploy](deploy.md#settings-while-it-runs)), on the page of the\n"
      "[live view](view.md) and as [parameters of ROS 2](ros2.md#parameters-and-life-cycle).\n"
      "Capacities are fixed at compile time, see [memory](memory.md).\n"
      "This page is written by `disflow_track --print-settings-table`.\n";
  const Config defaults;
  std::string_view section;
  VisitFields(defaults, [&](const auto& field) {
    const SettingName name(field.name);
    if (name.section != section) {
      section = name.section;
      text.append("\n## ").append(section).append("\n\n");
      text.append("| setting | default | range | unit | at run time | meaning |\n");
      text.append("|---|---|---|---|---|---|\n");
    }
    text.append("| `").append(field.name).append("` | ").append(Literal(field.value));
    text.append(" | ").append(NumberText(field.min)).append(" to ").append(NumberText(field.max));
    text.append(" | ").append(field.unit).append(field.at_run_time ? " | \u2713" : " | ");
    text.append(" | ").append(field.meaning).append(" |\n");
  });
  return text;
}

}  // namespace disflow::apps
