// SPDX-License-Identifier: BSD-3-Clause
#include "summary.h"

#include <string_view>

#include "units.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

/// Text in which Markdown sees no markup.
std::string Escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("\\`*_{}[]<>()#+!|~").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

/// A link target: every byte that could end it is written as %XX.
std::string Link(const fs::path& path) {
  std::string link;
  for (const char c : path.generic_string()) {
    const bool plain = std::string_view("-._/").find(c) != std::string_view::npos ||
                       (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    link += plain ? std::string(1, c) : Format("%%%02X", static_cast<unsigned char>(c));
  }
  return link;
}

}  // namespace

std::string FormatSummary(const Report& report, const std::vector<Plot>& plots,
                          const fs::path& summary_dir, const fs::path& plots_dir) {
  std::string page = "# Tracking result\n\n";
  page += "Sequence " + Escape(report.sequence) + ", trajectory " + Escape(report.csv) +
          ", model " + Escape(report.model) + ".\n";
  std::string group;
  for (const ReportRow& row : Rows(report)) {
    if (row.group != group) page += "\n| " + row.group + " | |\n|---|---|\n";
    group = row.group;
    page += "| " + Escape(row.name) + " | " + row.value + " |\n";
  }
  // A file in the current folder has an empty parent path, of which absolute() makes an error.
  const fs::path base = fs::absolute(summary_dir / ".").lexically_normal();
  for (const Plot& plot : plots) {
    const fs::path file = fs::absolute(plots_dir / plot.file).lexically_normal();
    page += "\n![" + Escape(plot.title) + "](" + Link(file.lexically_relative(base)) + ")\n";
  }
  return page;
}

}  // namespace disflow::apps
