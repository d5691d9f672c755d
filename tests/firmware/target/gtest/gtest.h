// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A stand-in for the part of GoogleTest that the unit tests of core use, for targets without
/// files, threads and exceptions, on which GoogleTest does not build.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <tuple>
#include <type_traits>

namespace testing {

class Test {
 public:
  virtual ~Test() = default;
  virtual void SetUp() {}
  virtual void TearDown() {}
  virtual void TestBody() = 0;
};

template <class T>
class TestWithParam : public Test {
 public:
  using ParamType = T;
  [[nodiscard]] static const T& GetParam() { return *parameter; }
  static inline const T* parameter = nullptr;
};

template <class... T>
struct ValueList {
  std::tuple<T...> values;
  template <class Param, class Use>
  void ForEach(Use use) const {
    std::apply([&](const auto&... value) { (use(Param(value)), ...); }, values);
  }
};
template <class... T>
[[nodiscard]] ValueList<T...> Values(T... values) {
  return {{values...}};
}

template <class T>
struct RangeOf {
  T begin, end, step;
  template <class Param, class Use>
  void ForEach(Use use) const {
    for (T value = begin; value < end; value = static_cast<T>(value + step)) use(Param(value));
  }
};
template <class T>
[[nodiscard]] RangeOf<T> Range(T begin, T end, T step = 1) {
  return {begin, end, step};
}
struct PrintToStringParamName {};

namespace internal {

/// Makes the test that is running a failed one, and says where.
void Fail(const char* file, int line, const char* what);
/// Runs one test: name, then the making of it.
void Run(const char* suite, const char* name, Test* (*make)());

/// Text behind a check; not printed here.
struct Message {
  template <class T>
  const Message& operator<<(const T& /*text*/) const {
    return *this;
  }
};
struct Nothing {
  void operator=(const Message& /*message*/) const {}
};

/// A node of a list of what runs; the lists are made before main().
struct Registered {
  Registered(const char* suite_name, const char* test_name, void (*run_it)(const Registered&),
             Registered*& list)
      : suite(suite_name), name(test_name), run(run_it), next(list) {
    list = this;
  }
  const char* suite;
  const char* name;
  void (*run)(const Registered&);
  Registered* next;
};
inline Registered* all = nullptr;

template <class TestClass>
Test* Make() {
  return new TestClass;
}
template <class TestClass>
void RunOne(const Registered& test) {
  Run(test.suite, test.name, &Make<TestClass>);
}

/// The parameterised tests of a suite.
template <class Suite>
struct ParameterTests {
  static inline Registered* list = nullptr;
};

inline bool AlmostEqual(float a, float b) {
  std::int32_t bits_a, bits_b;
  std::memcpy(&bits_a, &a, sizeof a);
  std::memcpy(&bits_b, &b, sizeof b);
  const auto biased = [](std::int32_t bits) {
    return bits < 0 ? -std::int64_t{bits & 0x7FFFFFFF} : std::int64_t{bits};
  };
  const std::int64_t apart = biased(bits_a) - biased(bits_b);
  return a == b || (apart >= -4 && apart <= 4 && a == a && b == b);
}

}  // namespace internal
}  // namespace testing

#define DISFLOW_TEST_CLASS(suite, name) suite##_##name##_Test
#define DISFLOW_TEST(suite, name, base)                                             \
  class DISFLOW_TEST_CLASS(suite, name) : public base {                             \
    void TestBody() override;                                                       \
  };                                                                                \
  static ::testing::internal::Registered suite##_##name##_registered(               \
      #suite, #name, &::testing::internal::RunOne<DISFLOW_TEST_CLASS(suite, name)>, \
      ::testing::internal::all);                                                    \
  void DISFLOW_TEST_CLASS(suite, name)::TestBody()

#define TEST(suite, name) DISFLOW_TEST(suite, name, ::testing::Test)
#define TEST_F(suite, name) DISFLOW_TEST(suite, name, suite)
#define TEST_P(suite, name)                                                         \
  class DISFLOW_TEST_CLASS(suite, name) : public suite {                            \
    void TestBody() override;                                                       \
  };                                                                                \
  static ::testing::internal::Registered suite##_##name##_registered(               \
      #suite, #name, &::testing::internal::RunOne<DISFLOW_TEST_CLASS(suite, name)>, \
      ::testing::internal::ParameterTests<suite>::list);                            \
  void DISFLOW_TEST_CLASS(suite, name)::TestBody()

#define INSTANTIATE_TEST_SUITE_P(prefix, suite, generator, ...)                            \
  static ::testing::internal::Registered prefix##_##suite##_registered(                    \
      #prefix, #suite,                                                                     \
      [](const ::testing::internal::Registered&) {                                         \
        (generator).template ForEach<suite::ParamType>([](const suite::ParamType& value) { \
          suite::parameter = &value;                                                       \
          using List = ::testing::internal::ParameterTests<suite>;                         \
          for (const auto* test = List::list; test != nullptr; test = test->next) {        \
            test->run(*test);                                                              \
          }                                                                                \
        });                                                                                \
      },                                                                                   \
      ::testing::internal::all)

// The switch keeps an else that follows from binding to the if.
#define DISFLOW_CHECK(condition, text, on_failure)                    \
  switch (0)                                                          \
  case 0:                                                             \
  default:                                                            \
    if (condition)                                                    \
      ;                                                               \
    else                                                              \
      on_failure(::testing::internal::Fail(__FILE__, __LINE__, text), \
                 ::testing::internal::Message())
#define DISFLOW_GO_ON(fail, message) fail, message
#define DISFLOW_LEAVE(fail, message) return fail, ::testing::internal::Nothing() = message

#define ADD_FAILURE() DISFLOW_CHECK(false, "failure", DISFLOW_GO_ON)
#define EXPECT_TRUE(a) DISFLOW_CHECK(static_cast<bool>(a), #a, DISFLOW_GO_ON)
#define EXPECT_FALSE(a) DISFLOW_CHECK(!static_cast<bool>(a), "not " #a, DISFLOW_GO_ON)
#define EXPECT_EQ(a, b) DISFLOW_CHECK((a) == (b), #a " == " #b, DISFLOW_GO_ON)
#define EXPECT_NE(a, b) DISFLOW_CHECK((a) != (b), #a " != " #b, DISFLOW_GO_ON)
#define EXPECT_LT(a, b) DISFLOW_CHECK((a) < (b), #a " < " #b, DISFLOW_GO_ON)
#define EXPECT_LE(a, b) DISFLOW_CHECK((a) <= (b), #a " <= " #b, DISFLOW_GO_ON)
#define EXPECT_GT(a, b) DISFLOW_CHECK((a) > (b), #a " > " #b, DISFLOW_GO_ON)
#define EXPECT_GE(a, b) DISFLOW_CHECK((a) >= (b), #a " >= " #b, DISFLOW_GO_ON)
#define EXPECT_NEAR(a, b, by) \
  DISFLOW_CHECK(std::abs(double(a) - double(b)) <= double(by), #a " near " #b, DISFLOW_GO_ON)
#define EXPECT_FLOAT_EQ(a, b) \
  DISFLOW_CHECK(::testing::internal::AlmostEqual(a, b), #a " ~ " #b, DISFLOW_GO_ON)
#define EXPECT_STREQ(a, b) DISFLOW_CHECK(std::strcmp(a, b) == 0, #a " is " #b, DISFLOW_GO_ON)
#define ASSERT_TRUE(a) DISFLOW_CHECK(static_cast<bool>(a), #a, DISFLOW_LEAVE)
#define ASSERT_FALSE(a) DISFLOW_CHECK(!static_cast<bool>(a), "not " #a, DISFLOW_LEAVE)
#define ASSERT_EQ(a, b) DISFLOW_CHECK((a) == (b), #a " == " #b, DISFLOW_LEAVE)
#define ASSERT_NE(a, b) DISFLOW_CHECK((a) != (b), #a " != " #b, DISFLOW_LEAVE)
#define ASSERT_LT(a, b) DISFLOW_CHECK((a) < (b), #a " < " #b, DISFLOW_LEAVE)
#define ASSERT_LE(a, b) DISFLOW_CHECK((a) <= (b), #a " <= " #b, DISFLOW_LEAVE)
#define ASSERT_GT(a, b) DISFLOW_CHECK((a) > (b), #a " > " #b, DISFLOW_LEAVE)
#define ASSERT_NEAR(a, b, by) \
  DISFLOW_CHECK(std::abs(double(a) - double(b)) <= double(by), #a " near " #b, DISFLOW_LEAVE)
