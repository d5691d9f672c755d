// SPDX-License-Identifier: BSD-3-Clause
#include "settings/setting_value.h"

#include <type_traits>

#include "disflow/config_fields.h"
#include "settings/refusal.h"

namespace disflow::apps {

void AssignSetting(const std::string& where, std::string_view name, const SettingNumber& number,
                   Config& config) {
  bool found = false;
  VisitFields(config, [&](const auto& field) {
    if (name != field.name) return;
    found = true;
    using Value = std::remove_reference_t<decltype(field.value)>;
    const std::string range =
        "allowed: " + NumberText(field.min) + " to " + NumberText(field.max) + " " + field.unit;
    if (std::is_integral_v<Value> && !number.is_integer) {
      Refuse(where, std::string(name) + " = " + number.text + " is not a whole number; " + range);
    }
    // Written so that NaN is refused too.
    if (!(number.value >= field.min && number.value <= field.max)) {
      Refuse(where, std::string(name) + " = " + number.text + " is out of range; " + range);
    }
    field.value = static_cast<Value>(number.value);
  });
  if (!found) {
    Refuse(where,
           "there is no setting " + std::string(name) + "; disflow_track --print-config lists all");
  }
}

}  // namespace disflow::apps
