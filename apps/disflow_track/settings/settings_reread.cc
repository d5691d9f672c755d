// SPDX-License-Identifier: BSD-3-Clause
#include "settings/settings_reread.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <type_traits>

#include "disflow/config_fields.h"
#include "program/exit_status.h"
#include "settings/refusal.h"
#include "settings/settings_text.h"

namespace disflow::apps {
namespace {

/// Options that are settings under another name: what becomes of them shows in the settings.
bool IsSetting(const std::string& option) {
  constexpr std::array kSettings = {"--set", "--roi", "--range", "--seed"};
  return std::find(kSettings.begin(), kSettings.end(), option) != kSettings.end();
}

bool SaysOtherwise(const std::vector<RunSetting>& settings, const RunSetting& wanted) {
  return std::none_of(settings.begin(), settings.end(), [&wanted](const RunSetting& setting) {
    return setting.SaysTheSameAs(wanted);
  });
}

void AddOptionsThatDiffer(const std::vector<RunSetting>& before,
                          const std::vector<RunSetting>& after, std::vector<std::string>& kept) {
  const auto add = [&kept](const std::vector<RunSetting>& some,
                           const std::vector<RunSetting>& others) {
    for (const RunSetting& setting : some) {
      const bool differs = !IsSetting(setting.option) && SaysOtherwise(others, setting);
      const bool is_named = std::find(kept.begin(), kept.end(), setting.option) != kept.end();
      if (differs && !is_named) kept.push_back(setting.option);
    }
  };
  add(before, after);
  add(after, before);
}

bool AreTheSame(const std::vector<ObjectTable>& before, const std::vector<ObjectTable>& after) {
  return std::equal(before.begin(), before.end(), after.begin(), after.end(),
                    [](const ObjectTable& a, const ObjectTable& b) {
                      return std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(),
                                        [](const RunSetting& x, const RunSetting& y) {
                                          return x.SaysTheSameAs(y);
                                        });
                    });
}

/// Calls visit(field before, field after) for every setting that is not the same in both.
template <class Visitor>
void VisitChanges(const Config& before, const Config& after, Visitor&& visit) {
  struct Value {
    const char* name;
    double value;
    bool at_run_time;
  };
  std::vector<Value> values;
  VisitFields(before, [&values](const auto& field) {
    values.push_back({field.name, static_cast<double>(field.value), field.at_run_time});
  });
  std::size_t place = 0;
  VisitFields(after, [&](const auto& field) {
    const Value& old = values[place++];
    if (old.value != static_cast<double>(field.value))
      visit(old, Value{field.name, static_cast<double>(field.value), field.at_run_time});
  });
}

void RefuseHalfWritten(const std::string& file) {
  const std::string text = ReadSettingsText(file);
  if (!text.empty() && text.back() == '\n') return;
  Refuse(file + ": ", text.empty() ? "is empty, as if it were just being written"
                                   : "does not end with a line break, as if it were just being "
                                     "written");
}

}  // namespace

RereadSettings ReadSettingsAgain(const CommandLine& command, const Options& running,
                                 std::span<const Config> now) {
  for (const std::string& file : running.settings_files) RefuseHalfWritten(file);
  RereadSettings reread;
  for (std::size_t i = 0; i < now.size(); ++i) {
    bool exit_now = false;
    const Options options = ParseCommandLine(command.argc, command.argv, exit_now, now[i]);
    if (i == 0) {
      AddOptionsThatDiffer(running.file.run, options.file.run, reread.kept);
      if (!AreTheSame(running.file.objects, options.file.objects))
        reread.kept.emplace_back("[[object]]");
    }
    // Objects that are more or fewer cannot be told from each other.
    const bool is_there = options.objects.size() == now.size();
    reread.wanted.push_back(is_there ? options.objects[i].config : now[i]);
    VisitChanges(now[i], reread.wanted.back(), [&reread](const auto& old, const auto& field) {
      const bool is_named =
          std::find(reread.kept.begin(), reread.kept.end(), field.name) != reread.kept.end();
      if (!old.at_run_time && !is_named) reread.kept.emplace_back(field.name);
    });
  }
  return reread;
}

void ApplyChanges(const Config& before, const Config& after, Config& config) {
  std::map<std::string_view, double> changed;
  VisitChanges(before, after,
               [&changed](const auto&, const auto& field) { changed[field.name] = field.value; });
  VisitFields(config, [&changed](const auto& field) {
    const auto change = changed.find(field.name);
    if (change == changed.end()) return;
    field.value = static_cast<std::remove_reference_t<decltype(field.value)>>(change->second);
  });
}

std::vector<std::string> DescribeChanges(const Config& before, const Config& after) {
  std::vector<std::string> changes;
  VisitChanges(before, after, [&changes](const auto& old, const auto& field) {
    changes.push_back(std::string(field.name) + " = " + NumberText(field.value) + " (was " +
                      NumberText(old.value) + ")");
  });
  return changes;
}

}  // namespace disflow::apps
