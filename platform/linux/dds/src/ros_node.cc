// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_node.h"

#include <algorithm>
#include <cstdio>

#include "ros_graph.h"
#include "ros_qos.h"

namespace disflow::posix {
namespace {

hal::Fault EntityFault(const char* what, const std::string& topic, dds_entity_t code) {
  return hal::MakeFault(Status::kIoError, "dds: no %s for %s: %s", what, topic.c_str(),
                        dds_strretcode(code));
}

}  // namespace

void AwaitReplyReaders(dds_entity_t requests, dds_entity_t replies) noexcept {
  constexpr int kTurns = 20;
  for (int i = 0; i < kTurns; ++i) {
    dds_subscription_matched_status_t clients{};
    dds_publication_matched_status_t readers{};
    if (dds_get_subscription_matched_status(requests, &clients) < 0) return;
    if (dds_get_publication_matched_status(replies, &readers) < 0) return;
    if (readers.current_count >= std::max(clients.current_count, 1U)) return;
    dds_sleepfor(DDS_MSECS(5));
  }
}

hal::Fault RosWait::Open(dds_entity_t participant, std::initializer_list<dds_entity_t> readers) {
  waitset_ = dds_create_waitset(participant);
  for (const dds_entity_t reader : readers) {
    const dds_entity_t condition = dds_create_readcondition(reader, DDS_ANY_STATE);
    const dds_return_t result =
        condition < 0 ? condition : dds_waitset_attach(waitset_, condition, 0);
    if (result < 0) return EntityFault("waiting", "what comes in", result);
  }
  return {};
}

void RosWait::For(std::int64_t timeout_ns) const noexcept {
  (void)dds_waitset_wait(waitset_, nullptr, 0, timeout_ns);
}

hal::Fault RosNode::Open(const Options& options) {
  options_ = options;
  const hal::Fault fault = OpenDomain(options.network, domain_);
  if (!fault.ok()) return fault;
  // By this key ROS 2 tells its own participants from others.
  const Qos qos = MakeQos(RosQos::kReliable, "enclave=/;");
  participant_ = dds_create_participant(options.network.domain, qos.get(), nullptr);
  return participant_ < 0 ? EntityFault("participant", "the domain", participant_) : hal::Fault{};
}

hal::Fault RosNode::AddWriter(const Endpoint& endpoint, dds_entity_t& writer) {
  const dds_entity_t topic =
      dds_create_topic(participant_, &endpoint.type, endpoint.topic.c_str(), nullptr, nullptr);
  if (topic < 0) return EntityFault("topic", endpoint.topic, topic);
  writer = dds_create_writer(participant_, topic, MakeQos(endpoint.qos, endpoint.user_data).get(),
                             nullptr);
  if (writer < 0) return EntityFault("writer", endpoint.topic, writer);
  writers_.push_back(writer);
  return {};
}

hal::Fault RosNode::AddReader(const Endpoint& endpoint, dds_entity_t& reader) {
  const dds_entity_t topic =
      dds_create_topic(participant_, &endpoint.type, endpoint.topic.c_str(), nullptr, nullptr);
  if (topic < 0) return EntityFault("topic", endpoint.topic, topic);
  reader = dds_create_reader(participant_, topic, MakeQos(endpoint.qos, endpoint.user_data).get(),
                             nullptr);
  if (reader < 0) return EntityFault("reader", endpoint.topic, reader);
  readers_.push_back(reader);
  return {};
}

std::string RosNode::ParticipantId() const {
  dds_guid_t guid{};
  (void)dds_get_guid(participant_, &guid);  // zeros would do as well
  std::string text;
  for (const std::uint8_t byte : guid.v) {
    char digits[3];
    (void)std::snprintf(digits, sizeof(digits), "%02x", byte);
    text += digits;
  }
  return text;
}

hal::Fault RosNode::Announce() {
  return AnnounceInGraph(participant_, {options_.name, options_.node_namespace, readers_, writers_},
                         options_.before_iron, graph_writer_);
}

bool RosNode::HasListeners() const noexcept {
  return std::any_of(writers_.begin(), writers_.end(), posix::HasListeners);
}

void RosNode::WaitForAcknowledgments(std::int64_t timeout_ns) noexcept {
  const dds_time_t end_ns = dds_time() + timeout_ns;
  for (const dds_entity_t writer : writers_) {
    (void)dds_wait_for_acks(writer, std::max<std::int64_t>(end_ns - dds_time(), 0));
  }
}

}  // namespace disflow::posix
