// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "disflow/posix/dds/ros_messages.h"
#include "objects/object_channel.h"

namespace disflow::apps {

/// Types of rcl_interfaces/msg/ParameterType.
inline constexpr std::uint8_t kParameterNotSet = 0;
inline constexpr std::uint8_t kParameterInteger = 2;
inline constexpr std::uint8_t kParameterDouble = 3;

/// One setting of one object as a parameter of ROS 2.
struct RosParameter {
  std::string name;        ///< "object.registration.iterations".
  std::size_t object = 0;  ///< Whose.
  std::size_t number = 0;  ///< Its place in VisitFields().
  bool is_whole = false;
  bool is_read_only = false;
  double min = 0.0;
  double max = 0.0;
  std::string description;
};

/// A name and the value that it shall have.
struct WantedParameter {
  std::string_view name;
  const posix::ros::ParameterValue& value;
};

/// All settings of all objects as parameters of ROS 2, which reads and changes them as they run.
class ParameterTable {
 public:
  explicit ParameterTable(std::span<ObjectChannel* const> channels);

  [[nodiscard]] const std::vector<RosParameter>& all() const noexcept { return parameters_; }
  /// @return Null if there is none.
  [[nodiscard]] const RosParameter* Find(std::string_view name) const noexcept;
  /// @return As its object has it now.
  [[nodiscard]] posix::ros::ParameterValue ValueOf(const RosParameter& parameter) const;
  /// Sets all or none. @return Why none; empty: all were.
  [[nodiscard]] std::string Set(std::span<const WantedParameter> wanted);
  /// What has changed since the last call, whoever changed it.
  [[nodiscard]] std::vector<const RosParameter*> TakeChanges();

  /// Names that list_parameters gives for this.
  /// @param prefix Empty: all. @param depth Parts behind the prefix at most; 0: any number.
  [[nodiscard]] std::vector<const RosParameter*> List(std::string_view prefix,
                                                      std::uint64_t depth) const;

 private:
  struct Object {
    ObjectChannel* channel;
    std::uint32_t version;
    std::vector<double> values;  ///< That were told last.
  };

  std::vector<RosParameter> parameters_;  ///< Object by object, in the order of VisitFields().
  std::vector<Object> objects_;
};

}  // namespace disflow::apps
