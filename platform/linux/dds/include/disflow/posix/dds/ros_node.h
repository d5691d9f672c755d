// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "disflow/posix/dds/dds_domain.h"
#include "disflow/posix/dds/ros_messages.h"
#include "disflow/posix/dds/ros_names.h"

/// @file
/// A ROS 2 node without ROS: topics and services over Cyclone DDS, named and typed as ROS 2's
/// middleware does it. docs/ros2.md says what a ROS 2 machine sees of it.

namespace disflow::posix {

enum class RosQos {
  kReliable,     ///< The last hundred are sent again until they arrive.
  kLatched,      ///< As kReliable, the last one; also to those who come later.
  kLatchedMany,  ///< As kReliable, also to those who come later.
  kSensorData,   ///< Best effort: what is lost is lost.
};

[[nodiscard]] inline bool HasListeners(dds_entity_t writer) noexcept {
  dds_publication_matched_status_t status;
  return dds_get_publication_matched_status(writer, &status) >= 0 && status.current_count > 0;
}

/// Writes one topic. Valid as long as its node.
template <class Message>
class RosPublisher {
 public:
  RosPublisher() = default;
  explicit RosPublisher(dds_entity_t writer) noexcept : writer_(writer) {}

  /// @return false if the message could not be queued for sending.
  [[nodiscard]] bool Publish(const Message& message) noexcept {
    return dds_write(writer_, &message) >= 0;
  }
  /// @return true if there is a listener, so that large messages are made only when they are
  /// wanted.
  [[nodiscard]] bool HasListeners() const noexcept { return posix::HasListeners(writer_); }

 private:
  dds_entity_t writer_ = 0;
};

/// A message that is received into the same memory again and again.
template <class Message>
struct RosSample {
  RosSample() = default;
  RosSample(const RosSample&) = delete;
  RosSample& operator=(const RosSample&) = delete;
  ~RosSample() { dds_sample_free(&message, &DescriptorOf<Message>(), DDS_FREE_CONTENTS); }

  Message message{};
};

/// Reads one topic. Valid as long as its node.
template <class Message>
class RosSubscription {
 public:
  RosSubscription() = default;
  explicit RosSubscription(dds_entity_t reader) noexcept : reader_(reader) {}

  /// Calls `take(message)` for what has come in, at most kBatch messages; never waits.
  template <class Take>
  void TakeAll(Take&& take) {
    TakeAllOf([](dds_instance_handle_t) { return true; }, take);
  }

  /// As TakeAll(), of those writers for which `accept(writer)` is true; of others it is lost.
  template <class Accept, class Take>
  void TakeAllOf(Accept&& accept, Take&& take) {
    constexpr std::size_t kBatch = 32;
    std::array<void*, kBatch> messages{};
    std::array<dds_sample_info_t, kBatch> infos;
    const int count = dds_take(reader_, messages.data(), infos.data(), kBatch, kBatch);
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
      if (!infos[i].valid_data || !accept(infos[i].publication_handle)) continue;
      take(*static_cast<const Message*>(messages[i]));
    }
    if (count > 0) (void)dds_return_loan(reader_, messages.data(), count);
  }

  /// Takes the oldest message that has come in; never waits. Sequences that own their memory grow
  /// as the message demands, those that do not are cut to what they have.
  /// @return false if none has.
  [[nodiscard]] bool TakeOne(RosSample<Message>& sample) noexcept {
    void* target = &sample.message;
    dds_sample_info_t info;
    while (dds_take(reader_, &target, &info, 1, 1) > 0) {
      if (info.valid_data) return true;  // else it says that a writer went
    }
    return false;
  }

  /// Writers that are there now.
  [[nodiscard]] std::uint32_t writers() const noexcept {
    dds_subscription_matched_status_t status{};
    (void)dds_get_subscription_matched_status(reader_, &status);
    return status.current_count;
  }
  [[nodiscard]] dds_entity_t reader() const noexcept { return reader_; }

 private:
  dds_entity_t reader_ = 0;
};

/// Waits until one of several topics has something. Valid as long as its node.
class RosWait {
 public:
  [[nodiscard]] hal::Fault Open(dds_entity_t participant,
                                std::initializer_list<dds_entity_t> readers);
  void For(std::int64_t timeout_ns) const noexcept;

 private:
  dds_entity_t waitset_ = 0;
};

/// Waits a moment until as many read the replies as write the requests: DDS finds a client's two
/// ends one after the other, and a reply to the first request would be lost.
void AwaitReplyReaders(dds_entity_t requests, dds_entity_t replies) noexcept;

/// The two topics of a service, as rmw_cyclonedds has them: the client's header comes with the
/// request and goes back with the reply.
template <class Request, class Response>
class RosService {
 public:
  RosService() = default;
  RosService(dds_entity_t reader, dds_entity_t writer) noexcept
      : requests(reader), reader_(reader), writer_(writer) {}

  /// @param response With the request's header. If it cannot be sent, only the client misses it.
  void Reply(const Response& response) noexcept {
    AwaitReplyReaders(reader_, writer_);
    (void)dds_write(writer_, &response);
  }

  RosSubscription<Request> requests;

 private:
  dds_entity_t reader_ = 0;
  dds_entity_t writer_ = 0;
};

/// One node in one participant.
class RosNode {
 public:
  struct Options {
    DdsNetwork network;
    std::string name = "disflow";
    std::string node_namespace{};  ///< "/robot1"; empty: none.
    bool before_iron = false;      ///< Announce the node as ROS 2 Humble and older understand it.
  };

  RosNode() = default;

  /// Opens domain and participant.
  [[nodiscard]] hal::Fault Open(const Options& options);

  /// @param name Fully qualified, see IsRosName().
  template <class Message>
  [[nodiscard]] hal::Fault Advertise(const std::string& name, RosQos qos,
                                     RosPublisher<Message>& publisher) {
    dds_entity_t writer = 0;
    const hal::Fault fault = AddWriter({DescriptorOf<Message>(), TopicName(name), qos, {}}, writer);
    publisher = RosPublisher<Message>(writer);
    return fault;
  }
  template <class Message>
  [[nodiscard]] hal::Fault Subscribe(const std::string& name, RosQos qos,
                                     RosSubscription<Message>& subscription) {
    dds_entity_t reader = 0;
    const hal::Fault fault = AddReader({DescriptorOf<Message>(), TopicName(name), qos, {}}, reader);
    subscription = RosSubscription<Message>(reader);
    return fault;
  }
  template <class Request, class Response>
  [[nodiscard]] hal::Fault Serve(const std::string& name, RosService<Request, Response>& service) {
    // Clients of rmw_cyclonedds tell by this which writer answers which reader.
    const std::string id = "serviceid=" + ParticipantId() + name + ";";
    dds_entity_t reader = 0;
    dds_entity_t writer = 0;
    hal::Fault fault =
        AddReader({DescriptorOf<Request>(), RequestTopicName(name), RosQos::kReliable, id}, reader);
    if (!fault.ok()) return fault;
    fault =
        AddWriter({DescriptorOf<Response>(), ReplyTopicName(name), RosQos::kReliable, id}, writer);
    service = RosService<Request, Response>(reader, writer);
    return fault;
  }

  /// Tells the ROS graph who is here, with all topics and services made so far. May be called again
  /// when there are more.
  [[nodiscard]] hal::Fault Announce();

  [[nodiscard]] const Options& options() const noexcept { return options_; }
  /// With its namespace: "/robot1/disflow".
  [[nodiscard]] std::string full_name() const {
    return options_.node_namespace + "/" + options_.name;
  }
  [[nodiscard]] dds_entity_t participant() const noexcept { return participant_; }

  /// @return true if anything of this node is listened to.
  [[nodiscard]] bool HasListeners() const noexcept;

  /// Waits until all that listen reliably have everything, or the time is over.
  void WaitForAcknowledgments(std::int64_t timeout_ns) noexcept;

 private:
  struct Endpoint {
    const dds_topic_descriptor_t& type;
    std::string topic;  ///< Of DDS.
    RosQos qos;
    std::string user_data;
  };

  [[nodiscard]] hal::Fault AddWriter(const Endpoint& endpoint, dds_entity_t& writer);
  [[nodiscard]] hal::Fault AddReader(const Endpoint& endpoint, dds_entity_t& reader);
  [[nodiscard]] std::string ParticipantId() const;

  Options options_;
  DdsEntity domain_;
  dds_entity_t participant_ = 0;  ///< With all its children deleted with the domain.
  std::vector<dds_entity_t> writers_;
  std::vector<dds_entity_t> readers_;
  dds_entity_t graph_writer_ = 0;  ///< Of Announce(), once it was called.
};

}  // namespace disflow::posix
