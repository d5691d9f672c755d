// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "disflow/config.h"
#include "settings/setting_value.h"

namespace disflow::apps {

/// One line of a settings file: an option of the command line or of an object.
struct RunSetting {
  std::string where;   ///< For messages: file and line.
  std::string option;  ///< "--rate".
  std::vector<std::string> values;

  [[nodiscard]] bool SaysTheSameAs(const RunSetting& other) const {
    return option == other.option && values == other.values;
  }
};

/// One [[object]] of a settings file.
struct ObjectTable {
  std::string where;
  std::vector<RunSetting> keys;  ///< What is no section; the option is the key itself.
  Config config;                 ///< The file's, then the sections of this object.
};

/// A setting of one object, which stands elsewhere: a parameter of ROS.
struct NamedSetting {
  std::string where;
  std::string object;
  std::string name;  ///< "registration.iterations".
  SettingNumber number;
};

struct SettingsFile {
  std::vector<RunSetting> run;
  std::vector<ObjectTable> objects;
  std::vector<NamedSetting> named;  ///< In the order in which they hold.
};

}  // namespace disflow::apps
