// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// DisFlow's end of the wire test, driven by wire_test.js.
///   wire_peer send URI VECTORS.json   encodes and sends the messages, then waits for end of input
///   wire_peer receive URI COUNT       prints "ready", then COUNT decoded messages as JSON lines
///   and
///                                     one line with the decoder's counters
/// With key=FILE in the URI all that is sent is signed, and only what is signed counts.

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/posix/link.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/signing_key_file.h"
#include "disflow/posix/signing_time_file.h"

namespace {

using nlohmann::json;
using namespace disflow;
using namespace disflow::hal::mavlink;

constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr int kPatienceMs = 10'000;

[[noreturn]] void Fail(const std::string& message) {
  std::fprintf(stderr, "wire_peer: %s\n", message.c_str());
  std::exit(1);
}

/// Fills a message's fields from JSON by their MAVLink names.
class JsonReader {
 public:
  explicit JsonReader(const json& fields) : fields_(fields) {}

  template <class T>
  void operator()(const char* name, T& value, FieldKind /*kind*/ = FieldKind::kBase) {
    value = Parse<T>(fields_.at(name));
  }
  template <class T, std::size_t kSize>
  void operator()(const char* name, std::array<T, kSize>& values,
                  FieldKind /*kind*/ = FieldKind::kBase) {
    for (std::size_t i = 0; i < kSize; ++i) values[i] = Parse<T>(fields_.at(name).at(i));
  }

 private:
  template <class T>
  static T Parse(const json& value) {
    if (!value.is_string()) return value.get<T>();
    const std::string text = value;
    if constexpr (std::is_floating_point_v<T>) {
      if (text == "NaN") return std::numeric_limits<T>::quiet_NaN();
      return std::numeric_limits<T>::infinity();
    } else {
      T number{};
      std::from_chars(text.data(), text.data() + text.size(), number);
      return number;
    }
  }

  const json& fields_;
};

/// The reverse of JsonReader.
class JsonWriter {
 public:
  template <class T>
  void operator()(const char* name, const T& value, FieldKind /*kind*/ = FieldKind::kBase) {
    fields[name] = Print(value);
  }
  template <class T, std::size_t kSize>
  void operator()(const char* name, const std::array<T, kSize>& values,
                  FieldKind /*kind*/ = FieldKind::kBase) {
    for (const T& value : values) fields[name].push_back(Print(value));
  }

  json fields;

 private:
  template <class T>
  static json Print(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      if (value != value) return "NaN";
      if (value > std::numeric_limits<T>::max()) return "Infinity";
    }
    if constexpr (sizeof(T) == 8) return std::to_string(value);
    return value;
  }
};

template <class Message>
std::size_t EncodeFromJson(const json& vector, std::span<std::byte> out) {
  Message message;
  JsonReader reader(vector.at("fields"));
  Message::VisitFields(message, reader);
  const FrameHeader header{.sequence = vector.at("sequence"),
                           .system_id = vector.at("system_id"),
                           .component_id = vector.at("component_id")};
  const auto size = EncodeFrame(message, header, out);
  if (!size.ok()) Fail(Describe(size.status));
  return size.value;
}

std::size_t Encode(const json& vector, std::span<std::byte> out) {
  const std::string name = vector.at("message");
  if (name == Heartbeat::kName) return EncodeFromJson<Heartbeat>(vector, out);
  if (name == Odometry::kName) return EncodeFromJson<Odometry>(vector, out);
  if (name == DisflowStatus::kName) return EncodeFromJson<DisflowStatus>(vector, out);
  if (name == DisflowReady::kName) return EncodeFromJson<DisflowReady>(vector, out);
  if (name == DisflowTiming::kName) return EncodeFromJson<DisflowTiming>(vector, out);
  if (name == DisflowQuery::kName) return EncodeFromJson<DisflowQuery>(vector, out);
  if (name == DisflowField::kName) return EncodeFromJson<DisflowField>(vector, out);
  if (name == CommandLong::kName) return EncodeFromJson<CommandLong>(vector, out);
  if (name == CommandAck::kName) return EncodeFromJson<CommandAck>(vector, out);
  if (name == SystemTime::kName) return EncodeFromJson<SystemTime>(vector, out);
  if (name == TimeSyncMessage::kName) return EncodeFromJson<TimeSyncMessage>(vector, out);
  if (name == LandingTarget::kName) return EncodeFromJson<LandingTarget>(vector, out);
  if (name == FollowTarget::kName) return EncodeFromJson<FollowTarget>(vector, out);
  if (name == GpsGlobalOrigin::kName) return EncodeFromJson<GpsGlobalOrigin>(vector, out);
  Fail("unknown message " + name);
}

template <class Message>
bool PrintIf(const FrameView& frame) {
  Message message;
  if (DecodePayload(frame, message) != Status::kOk) return false;
  JsonWriter writer;
  Message::VisitFields(message, writer);
  std::cout << json{{"message", Message::kName},
                    {"sequence", frame.header.sequence},
                    {"system_id", frame.header.system_id},
                    {"component_id", frame.header.component_id},
                    {"signed", frame.is_signed},
                    {"fields", writer.fields}}
            << std::endl;
  return true;
}

constexpr std::uint8_t kLinkId = 3;

/// A peer over TCP may still be on its way.
void SendWhenSomebodyIsThere(hal::ByteLink& link, std::span<const std::byte> message) {
  posix::MonotonicClock clock;
  const std::uint32_t sent = link.counters().sent_messages;
  for (int waited_ms = 0; waited_ms < kPatienceMs; ++waited_ms) {
    const hal::Fault fault = link.Send(message);
    if (!fault.ok()) Fail(fault.message);
    if (link.counters().sent_messages > sent) return;
    clock.SleepUntilNs(clock.NowNs() + kNsPerMs);
  }
  Fail("nobody is there");
}

int Send(hal::ByteLink& link, SigningSession* session, const char* path) {
  std::ifstream file(path);
  const json vectors = json::parse(file);
  std::array<std::byte, kMaxFrameSize> buffer{};
  for (const json& vector : vectors.at("messages")) {
    std::size_t size = Encode(vector, buffer);
    if (session != nullptr) {
      const auto frame = buffer;
      const auto signed_size = session->Sign(std::span(frame).first(size), kLinkId, buffer);
      if (!signed_size.ok()) Fail(Describe(signed_size.status));
      size = signed_size.value;
    }
    SendWhenSomebodyIsThere(link, std::span(buffer).first(size));
  }
  // The far end says when it has everything, so that closing the link cuts nothing off.
  while (std::getchar() != EOF) {
  }
  return 0;
}

int Receive(hal::ByteLink& link, SigningSession* session, std::uint32_t count) {
  posix::MonotonicClock clock;
  FrameDecoder decoder;
  std::array<std::byte, 2048> buffer{};  // A datagram is never longer here.
  std::cout << "\"ready\"" << std::endl;
  for (int waited_ms = 0; waited_ms < kPatienceMs && decoder.counters().frames < count;) {
    const auto received = link.Receive(buffer);
    if (!received.ok()) Fail(Describe(received.status));
    if (received.value == 0) {
      clock.SleepUntilNs(clock.NowNs() + kNsPerMs);
      ++waited_ms;
    }
    const auto bytes = std::span<const std::byte>(buffer).first(received.value);
    decoder.ForEachFrame(bytes, session, [](const FrameView& frame) {
      // Whichever it is; the decoder knows no other.
      (void)(PrintIf<Heartbeat>(frame) || PrintIf<Odometry>(frame) ||
             PrintIf<DisflowStatus>(frame) || PrintIf<DisflowReady>(frame) ||
             PrintIf<DisflowTiming>(frame) || PrintIf<DisflowQuery>(frame) ||
             PrintIf<DisflowField>(frame) || PrintIf<CommandLong>(frame) ||
             PrintIf<CommandAck>(frame) || PrintIf<SystemTime>(frame) ||
             PrintIf<TimeSyncMessage>(frame) || PrintIf<LandingTarget>(frame) ||
             PrintIf<FollowTarget>(frame) || PrintIf<GpsGlobalOrigin>(frame));
    });
  }
  const DecoderCounters& counters = decoder.counters();
  std::cout << json{{"frames", counters.frames},
                    {"bad_checksum", counters.bad_checksum},
                    {"unknown_id", counters.unknown_id},
                    {"without_signature", counters.without_signature},
                    {"wrong_signature", counters.wrong_signature},
                    {"replayed", counters.replayed},
                    {"outdated", counters.outdated}}
            << std::endl;
  return counters.frames == count ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) Fail("usage: wire_peer send URI VECTORS.json | wire_peer receive URI COUNT");
  posix::Link link;
  hal::Fault fault = link.Configure(argv[2]);
  if (fault.ok()) fault = link.get()->Open();
  if (!fault.ok()) Fail(fault.message);
  std::optional<SigningSession> session;
  if (link.address().key_file[0] != '\0') {
    SigningKey key{};
    fault = posix::ReadSigningKey(link.address().key_file, key);
    if (!fault.ok()) Fail(fault.message);
    session.emplace(key, posix::SigningTimeNow());
  }
  SigningSession* const signing = session ? &*session : nullptr;
  if (std::string(argv[1]) == "send") return Send(*link.get(), signing, argv[3]);
  return Receive(*link.get(), signing, static_cast<std::uint32_t>(std::atoi(argv[3])));
}
