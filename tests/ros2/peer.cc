// SPDX-License-Identifier: BSD-3-Clause
//
// A DDS participant that shares no code with the program under test: Fast DDS, and messages as
// bytes that only their type's name tells apart, which is how ROS 2's own middleware uses it.
// Whoever runs it says on standard input what to do, one command a line, and gets one line back:
//
//   subscribe TOPIC TYPE QOS FILE               samples are appended to FILE: length (4 bytes,
//   little
//                                               endian), then the bytes with their encapsulation
//   count TOPIC                                 samples received so far
//   publish TOPIC TYPE QOS FILE                 one sample, the bytes of FILE, once somebody
//                                               listens
//   keep TOPIC TYPE QOS FILE                    the same at once, for those who come later
//   unpublish TOPIC                             takes the writer away again
//   call REQUEST_TOPIC TYPE REPLY_TOPIC TYPE REQUEST_FILE REPLY_FILE
//
// QOS is reliable, latched (reliable, also for those who come later), best_effort or
// best_effort_latched.

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <atomic>
#include <chrono>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using Bytes = std::vector<char>;

constexpr std::uint32_t kLargest = 16U << 20U;

/// A message as bytes; the first four say how they are encoded.
class AnyType final : public dds::TopicDataType {
 public:
  explicit AnyType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kLargest;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

/// Appends what comes in to a file.
class Recorder final : public dds::DataReaderListener {
 public:
  explicit Recorder(const std::string& path) : file_(path, std::ios::binary) {}

  void on_data_available(dds::DataReader* reader) override {
    Bytes bytes;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      const auto size = static_cast<std::uint32_t>(bytes.size());
      file_.write(reinterpret_cast<const char*>(&size), sizeof(size));
      file_.write(bytes.data(), size);
      file_.flush();
      ++count_;
    }
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  std::ofstream file_;
  std::atomic<int> count_ = 0;
};

template <class Qos>
void Apply(const std::string& name, Qos& qos) {
  qos.reliability().kind = name.starts_with("best_effort") ? dds::BEST_EFFORT_RELIABILITY_QOS
                                                           : dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = name.ends_with("latched") ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                    : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 100;
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
}

class Peer {
 public:
  /// Finds others on this machine's loopback alone, by unicast.
  explicit Peer(std::uint32_t domain) {
    dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
    auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    transport->interfaceWhiteList.emplace_back("127.0.0.1");
    transport->maxInitialPeersRange = 10;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(transport);
    rtps::Locator_t loopback;
    loopback.kind = LOCATOR_KIND_UDPv4;
    rtps::IPLocator::setIPv4(loopback, 127, 0, 0, 1);
    qos.wire_protocol().builtin.initialPeersList.push_back(loopback);
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(domain, qos);
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  std::string Do(const std::string& line) {
    std::istringstream words(line);
    const std::vector<std::string> word{std::istream_iterator<std::string>(words), {}};
    if (word.size() == 5 && word[0] == "subscribe") {
      Subscribe(word[1], word[2], word[3], word[4]);
      return "subscribed";
    }
    if (word.size() == 2 && word[0] == "count") {
      return std::to_string(recorders_.at(word[1])->count());
    }
    if (word.size() == 5 && word[0] == "publish") {
      return Publish(word[1], word[2], word[3], word[4]) ? "published" : "nobody listens";
    }
    if (word.size() == 5 && word[0] == "keep") {
      Bytes bytes = Read(word[4]);
      return WriterOf(word[1], word[2], word[3])->write(&bytes) ? "kept" : "not written";
    }
    if (word.size() == 2 && word[0] == "unpublish") {
      return Unpublish(word[1]) ? "unpublished" : "never published";
    }
    if (word.size() == 7 && word[0] == "call") {
      return Call(word) ? "answered" : "no answer";
    }
    throw std::runtime_error("cannot understand: " + line);
  }

 private:
  static constexpr int kTurns = 1000;
  static constexpr int kAttempts = 3;
  static constexpr std::chrono::milliseconds kTurn{10};
  static constexpr std::chrono::milliseconds kSettle{500};

  template <class Condition>
  static bool Await(Condition&& condition) {
    for (int i = 0; i < kTurns && !condition(); ++i) std::this_thread::sleep_for(kTurn);
    return condition();
  }

  dds::Topic* TopicOf(const std::string& name, const std::string& type) {
    if (dds::Topic*& topic = topics_[name]; topic != nullptr) return topic;
    dds::TypeSupport(new AnyType(type)).register_type(participant_);
    return topics_[name] = participant_->create_topic(name, type, dds::TOPIC_QOS_DEFAULT);
  }

  Recorder& Subscribe(const std::string& topic, const std::string& type,
                      const std::string& qos_name, const std::string& path) {
    auto& recorder = recorders_[topic];
    recorder = std::make_unique<Recorder>(path);
    dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
    Apply(qos_name, qos);
    if (subscriber_->create_datareader(TopicOf(topic, type), qos, recorder.get()) == nullptr) {
      throw std::runtime_error("no reader for " + topic);
    }
    return *recorder;
  }

  dds::DataWriter* WriterOf(const std::string& topic, const std::string& type,
                            const std::string& qos_name) {
    dds::DataWriter*& writer = writers_[topic];
    if (writer != nullptr) return writer;
    dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
    Apply(qos_name, qos);
    qos.reliable_writer_qos().times.heartbeatPeriod = eprosima::fastrtps::Duration_t(0.1);
    return writer = publisher_->create_datawriter(TopicOf(topic, type), qos);
  }

  static Bytes Read(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  bool Publish(const std::string& topic, const std::string& type, const std::string& qos,
               const std::string& path) {
    const bool is_new = writers_.count(topic) == 0;
    dds::DataWriter* const writer = WriterOf(topic, type, qos);
    const bool matched = Await([writer] {
      dds::PublicationMatchedStatus status;
      writer->get_publication_matched_status(status);
      return status.current_count > 0;
    });
    // The other side may not know of this match yet, and would not ask for what came before.
    if (is_new) std::this_thread::sleep_for(kSettle);
    Bytes bytes = Read(path);
    return matched && writer->write(&bytes);
  }

  bool Unpublish(const std::string& topic) {
    const auto writer = writers_.find(topic);
    if (writer == writers_.end()) return false;
    publisher_->delete_datawriter(writer->second);
    writers_.erase(writer);
    return true;
  }

  bool Call(const std::vector<std::string>& word) {
    if (recorders_.count(word[3]) == 0) Subscribe(word[3], word[4], "reliable", word[6]);
    const Recorder& replies = *recorders_.at(word[3]);
    const int before = replies.count();
    // The server's first reply is lost if it has not found the reader of replies yet.
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (!Publish(word[1], word[2], "reliable", word[5])) return false;
      if (Await([&] { return replies.count() > before; })) return true;
    }
    return false;
  }

  dds::DomainParticipant* participant_;
  dds::Publisher* publisher_;
  dds::Subscriber* subscriber_;
  std::map<std::string, dds::Topic*> topics_;
  std::map<std::string, dds::DataWriter*> writers_;
  std::map<std::string, std::unique_ptr<Recorder>> recorders_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: ros2_peer DOMAIN\n";
    return 2;
  }
  try {
    Peer peer(static_cast<std::uint32_t>(std::stoul(argv[1])));
    std::cout << "ready" << std::endl;
    for (std::string line; std::getline(std::cin, line);) std::cout << peer.Do(line) << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "ros2_peer: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
