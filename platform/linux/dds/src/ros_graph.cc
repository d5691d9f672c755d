// SPDX-License-Identifier: BSD-3-Clause
#include "ros_graph.h"

#include <cstring>
#include <vector>

#include "disflow/posix/dds/ros_messages.h"
#include "ros_qos.h"

namespace disflow::posix {
namespace {

/// The messages of ROS 2 Iron and later.
struct Current {
  using Gid = rmw_dds_common_msg_dds__Gid_;
  using Node = rmw_dds_common_msg_dds__NodeEntitiesInfo_;
  using Info = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
  static dds_topic_descriptor_t Descriptor() noexcept {
    return rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;
  }
};

/// Those before, under the same name.
struct BeforeIron {
  using Gid = disflow_dds_GidHumble;
  using Node = disflow_dds_NodeEntitiesInfoHumble;
  using Info = disflow_dds_ParticipantEntitiesInfoHumble;
  static dds_topic_descriptor_t Descriptor() noexcept {
    dds_topic_descriptor_t descriptor = disflow_dds_ParticipantEntitiesInfoHumble_desc;
    descriptor.m_typename = Current::Descriptor().m_typename;
    return descriptor;
  }
};

template <class Gid>
bool GidOf(dds_entity_t entity, Gid& gid) noexcept {
  dds_guid_t guid;
  if (dds_get_guid(entity, &guid) < 0) return false;
  std::memset(gid.data, 0, sizeof(gid.data));
  std::memcpy(gid.data, guid.v, sizeof(guid.v));
  return true;
}

template <class Gid>
std::vector<Gid> GidsOf(std::span<const dds_entity_t> entities) {
  std::vector<Gid> gids;
  for (const dds_entity_t entity : entities) {
    Gid gid;
    if (GidOf(entity, gid)) gids.push_back(gid);
  }
  return gids;
}

/// @return The writer, or what went wrong.
dds_entity_t MakeWriter(dds_entity_t participant, const dds_topic_descriptor_t& descriptor) {
  const dds_entity_t topic =
      dds_create_topic(participant, &descriptor, "ros_discovery_info", nullptr, nullptr);
  if (topic < 0) return topic;
  return dds_create_writer(participant, topic, MakeQos(RosQos::kLatched, {}).get(), nullptr);
}

template <class Messages>
dds_return_t Write(dds_entity_t participant, const GraphEntry& entry, dds_entity_t& writer) {
  if (writer <= 0) writer = MakeWriter(participant, Messages::Descriptor());
  if (writer < 0) return writer;
  auto readers = GidsOf<typename Messages::Gid>(entry.readers);
  auto writers = GidsOf<typename Messages::Gid>(entry.writers);
  const std::string node_namespace = entry.node_namespace.empty() ? "/" : entry.node_namespace;
  std::vector<typename Messages::Node> nodes(1);
  std::strncpy(nodes[0].node_namespace, node_namespace.c_str(),
               sizeof(nodes[0].node_namespace) - 1);
  std::strncpy(nodes[0].node_name, entry.node_name.c_str(), sizeof(nodes[0].node_name) - 1);
  Lend(readers, nodes[0].reader_gid_seq);
  Lend(writers, nodes[0].writer_gid_seq);
  typename Messages::Info info{};
  if (!GidOf(participant, info.gid)) return DDS_RETCODE_ERROR;
  Lend(nodes, info.node_entities_info_seq);
  return dds_write(writer, &info);
}

}  // namespace

hal::Fault AnnounceInGraph(dds_entity_t participant, const GraphEntry& entry, bool before_iron,
                           dds_entity_t& writer) {
  const dds_return_t result = before_iron ? Write<BeforeIron>(participant, entry, writer)
                                          : Write<Current>(participant, entry, writer);
  if (result >= 0) return {};
  return hal::MakeFault(Status::kIoError, "dds: the node cannot be announced: %s",
                        dds_strretcode(result));
}

}  // namespace disflow::posix
