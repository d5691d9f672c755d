// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "disflow/posix/dds/ros_node.h"
#include "objects/object_channel.h"
#include "settings/dds_address.h"

namespace disflow::apps {

/// Size of the depth images.
struct ImageSize {
  int width_px = 0;
  int height_px = 0;
};

/// @return Nothing for a point in a frame that is neither the camera's nor the world.
[[nodiscard]] std::optional<ObjectChoice> ChoiceOf(const posix::ros::PointStamped& clicked,
                                                   const DdsAddress& address);

/// @param choice What the request asks for; unchanged if it is refused.
/// @return Why it is refused; empty: it is not.
[[nodiscard]] std::string ReadChoice(const posix::ros::ChooseRequest& request,
                                     const ImageSize& image, ObjectChoice& choice);

/// What others on the network say an object is: clicked points and the service choose.
class DdsChoices {
 public:
  /// @param is_first Takes /clicked_point too, where RViz publishes what is clicked.
  /// @throws Failure kOutputFailed.
  DdsChoices(const DdsAddress& address, const std::string& prefix, bool is_first,
             const ImageSize& image, ObjectChannel& channel, posix::RosNode& node);

  void Turn();

 private:
  using Points = posix::RosSubscription<posix::ros::PointStamped>;
  using Service = posix::RosService<posix::ros::ChooseRequest, posix::ros::ChooseResponse>;

  void TakePoints(Points& points);

  const DdsAddress address_;
  ImageSize image_;
  ObjectChannel& channel_;
  Points own_points_;
  std::optional<Points> common_points_;
  Service service_;
};

}  // namespace disflow::apps
