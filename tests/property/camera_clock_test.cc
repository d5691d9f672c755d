// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "disflow/hal/camera_pose_history.h"
#include "disflow/hal/mavlink/camera_pose_input.h"
#include "message_line.h"

namespace disflow::hal {
namespace {

using BodyPose = Transform<World, Body, double>;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000 * kMs;
constexpr std::int64_t kStart_ns = 86'400 * kSecond_ns;
constexpr int kSeeds = 20;
constexpr std::int64_t kEnd_ns = kStart_ns + 20 * kSecond_ns;

using Random = std::mt19937_64;

std::int64_t Between(Random& random, std::int64_t least, std::int64_t most) {
  return std::uniform_int_distribution<std::int64_t>(least, most)(random);
}
bool Chance(Random& random, double share) {
  return std::uniform_real_distribution<double>(0.0, 1.0)(random) < share;
}
/// From 100 ms to 300 years, all sizes alike, of either sign.
std::int64_t AnyError(Random& random) {
  const double size = std::pow(10.0, std::uniform_real_distribution<double>(8.0, 18.9)(random));
  return (Chance(random, 0.5) ? 1 : -1) * std::llround(std::min(size, 9e18));
}

BodyPose PoseAt(std::int64_t now_ns) {
  Mat<double, 6> twist;
  twist << 0.3, -0.2, 0.1, 0.5, 1.0, -0.8;
  const double seconds = static_cast<double>(now_ns - kStart_ns) * 1e-9;
  return BodyPose{} * Transform<Body, Body, double>::Exp(seconds * twist);
}

CameraPoseHistory::Settings Live() {
  CameraPoseHistory::Settings settings;
  settings.max_lead_ns = 50 * kMs;
  return settings;
}

/// A history that gets what the other gets, without the wrong stamps.
class Twins {
 public:
  explicit Twins(const CameraPoseHistory::Settings& settings)
      : disturbed_(settings), spared_(settings) {}

  void AddRight(std::int64_t now_ns) {
    (void)disturbed_.Add(now_ns, PoseAt(now_ns), 0, now_ns);
    (void)spared_.Add(now_ns, PoseAt(now_ns), 0, now_ns);
  }
  void AddWrong(std::int64_t now_ns, std::int64_t error_ns) {
    const auto stamp = static_cast<StampNs>(static_cast<std::uint64_t>(now_ns) +
                                            static_cast<std::uint64_t>(error_ns));
    (void)disturbed_.Add(stamp, PoseAt(now_ns), 0, now_ns);
    ++wrong_;
  }
  [[nodiscard]] bool AgreeAt(StampNs stamp_ns) {
    Transform<World, Camera> a;
    Transform<World, Camera> b;
    const Status status = disturbed_.At(stamp_ns, a);
    return spared_.At(stamp_ns, b) == status && a.rotation() == b.rotation() &&
           a.translation() == b.translation();
  }
  [[nodiscard]] const CameraPoseHistory::Counters& counters() const {
    return disturbed_.counters();
  }
  [[nodiscard]] std::uint32_t wrong() const { return wrong_; }

 private:
  CameraPoseHistory disturbed_;
  CameraPoseHistory spared_;
  std::uint32_t wrong_ = 0;
};

TEST(CameraClockProperty, SingleWrongStamps_ChangeNoPoseAtAll) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Twins twins(Live());
    const std::int64_t period_ns = Between(random, 5, 50) * kMs;
    int since_wrong = 0;
    for (std::int64_t now_ns = kStart_ns; now_ns < kEnd_ns; now_ns += period_ns) {
      if (since_wrong > 2 && now_ns < kEnd_ns - kSecond_ns && Chance(random, 0.1)) {
        twins.AddWrong(now_ns - 1, AnyError(random));
        since_wrong = 0;
      }
      twins.AddRight(now_ns);
      ++since_wrong;
      for (const std::int64_t back_ns : {std::int64_t{0}, period_ns / 3, 30 * kMs, 150 * kMs})
        ASSERT_TRUE(twins.AgreeAt(now_ns - back_ns)) << seed << " " << since_wrong;
      ASSERT_TRUE(twins.AgreeAt(now_ns + period_ns / 2)) << seed;
    }
    EXPECT_GT(twins.wrong(), 20U);
    EXPECT_EQ(twins.counters().wrong_stamp, twins.wrong()) << seed;
  }
}

TEST(CameraClockProperty, WrongStampThatNobodyCouldTell_IsForgottenTwoPosesLater) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    // Sent to a replay ahead of its frames: a stamp in the future means nothing.
    Twins twins({});
    const std::int64_t period_ns = Between(random, 5, 30) * kMs;
    int since_wrong = 0;
    for (std::int64_t now_ns = kStart_ns; now_ns < kEnd_ns; now_ns += period_ns) {
      if (since_wrong > 12 && now_ns < kEnd_ns - kSecond_ns && Chance(random, 0.1)) {
        twins.AddWrong(now_ns - 1, Between(random, 3 * period_ns, 300 * kMs));
        since_wrong = 0;
      }
      twins.AddRight(now_ns);
      if (++since_wrong < 2) continue;
      for (const std::int64_t back_ns : {std::int64_t{0}, period_ns / 3, 30 * kMs, 150 * kMs})
        ASSERT_TRUE(twins.AgreeAt(now_ns - back_ns)) << seed << " " << since_wrong;
    }
    EXPECT_GT(twins.wrong(), 10U);
    EXPECT_EQ(twins.counters().wrong_stamp, twins.wrong()) << seed;
  }
}

std::vector<std::byte> Message(std::int64_t stamp_ns, const BodyPose& pose) {
  mavlink::Odometry odometry;
  odometry.time_usec = static_cast<std::uint64_t>(stamp_ns / 1000);
  odometry.x = static_cast<float>(pose.translation().x());
  odometry.y = static_cast<float>(pose.translation().y());
  odometry.z = static_cast<float>(pose.translation().z());
  const auto q = pose.rotation_quaternion();
  odometry.q = {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
                static_cast<float>(q.z())};
  odometry.frame_id = static_cast<std::uint8_t>(mavlink::MavFrame::kLocalFrd);
  odometry.quality = 50;
  std::array<std::byte, mavlink::kMaxFrameSize> buffer{};
  const auto size =
      mavlink::EncodeFrame(odometry, {.sequence = 0, .system_id = 1, .component_id = 1}, buffer);
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size.value)};
}

/// A carrier with a clock of its own, which is set, starts anew with it, and is wrong now and then;
/// and a tracker that reads its messages once per frame.
class Carrier {
 public:
  explicit Carrier(int seed)
      : random_(static_cast<std::uint64_t>(seed)),
        period_ns_(Between(random_, 5, 25) * kMs),
        sender_minus_own_ns_(Between(random_, -kStart_ns + 100 * kSecond_ns, kStart_ns)) {}

  void Run() {
    constexpr std::int64_t kFrame_ns = 33'333'333;
    for (std::int64_t now_ns = kStart_ns; now_ns < kStart_ns + 60 * kSecond_ns;
         now_ns += kFrame_ns) {
      MaybeSetClock(now_ns);
      for (; sent_at_ns_ <= now_ns; sent_at_ns_ += period_ns_) Send();
      while (!on_their_way_.empty() && on_their_way_.front().arrives_ns <= now_ns) {
        line_.Deliver(on_their_way_.front().bytes, now_ns);
        on_their_way_.erase(on_their_way_.begin());
      }
      Ask(now_ns);
    }
  }

  [[nodiscard]] int asked() const { return asked_; }
  [[nodiscard]] int matched() const { return matched_; }
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] int wrong() const { return wrong_; }
  [[nodiscard]] int events() const { return events_; }
  [[nodiscard]] const CameraPoseHistory::Counters& counters() const { return history_.counters(); }

 private:
  struct OnItsWay {
    std::int64_t arrives_ns;
    std::vector<std::byte> bytes;
  };

  void MaybeSetClock(std::int64_t now_ns) {
    if (now_ns - event_ns_ < 3 * kSecond_ns || !Chance(random_, 0.02)) return;
    event_ns_ = now_ns;
    ++events_;
    const std::int64_t size_ns = Between(random_, 100, 40'000) * kMs;
    switch (Between(random_, 0, 2)) {
      case 0:
        sender_minus_own_ns_ = Between(random_, 0, kSecond_ns) - now_ns;
        break;
      case 1:
        sender_minus_own_ns_ += size_ns;
        break;
      default:
        sender_minus_own_ns_ = std::max(sender_minus_own_ns_ - size_ns, -now_ns);
        break;
    }
  }

  void Send() {
    std::int64_t stamp_ns = sent_at_ns_ + sender_minus_own_ns_;
    if (++since_wrong_ > 3 && Chance(random_, 0.03)) {
      stamp_ns = Between(random_, 0, std::int64_t{1} << Between(random_, 40, 62));
      since_wrong_ = 0;
      ++wrong_;
    }
    on_their_way_.push_back({sent_at_ns_ + Between(random_, 1, 4) * kMs,
                             Message(std::max<std::int64_t>(stamp_ns, 0), PoseAt(sent_at_ns_))});
  }

  void Ask(std::int64_t now_ns) {
    Transform<World, Camera> T_wc;
    const std::int64_t stamp_ns = now_ns - 10 * kMs;
    const bool found = history_.At(stamp_ns, T_wc) == Status::kOk;
    if (now_ns - event_ns_ < kSecond_ns) return;
    ++asked_;
    if (!found) return;
    ++matched_;
    const double error =
        (T_wc.translation().cast<double>() - PoseAt(stamp_ns).translation()).norm();
    worst_ = std::max(worst_, error);
  }

  Random random_;
  std::int64_t period_ns_;
  std::int64_t sender_minus_own_ns_;
  CameraPoseHistory history_{Live()};
  mavlink::CameraPoseInput input_{{.system_id = 1, .own_clock = true}, history_};
  test::MessageLine<mavlink::CameraPoseInput> line_{input_};
  std::vector<OnItsWay> on_their_way_;
  std::int64_t sent_at_ns_ = kStart_ns;
  std::int64_t event_ns_ = kStart_ns;
  int since_wrong_ = 0;
  int events_ = 0;
  int wrong_ = 0;
  int asked_ = 0;
  int matched_ = 0;
  double worst_ = 0.0;
};

TEST(CameraClockProperty, ClockSetRestartedAndWrong_CostsASecondAndNoWrongPose) {
  int events = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Carrier carrier(seed);
    carrier.Run();
    events += carrier.events();
    EXPECT_GE(carrier.matched(), 0.99 * carrier.asked()) << seed;
    // 0.4 m/s for as long as a message may have waited for the frame, and been on its way.
    EXPECT_LT(carrier.worst(), 0.4 * 0.040) << seed;
    EXPECT_GE(carrier.counters().wrong_stamp, static_cast<std::uint32_t>(carrier.wrong())) << seed;
  }
  EXPECT_GT(events, 5 * kSeeds);
}

}  // namespace
}  // namespace disflow::hal
