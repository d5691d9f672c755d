// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Runs the unit tests of core on a controller. The tests, not the code under test, use a heap.

#include <cstdint>
#include <cstdlib>
#include <new>

#include "gtest/gtest.h"
#include "semihosting.h"

namespace {

using disflow::firmware_test::Print;

int failures = 0;

void PrintNumber(int number) {
  char text[12];
  char* at = text + sizeof(text) - 1;
  *at = '\0';
  do {
    *--at = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  Print(at);
}

[[noreturn]] void GiveUp(const char* why) {
  Print(why);
  Print("\n");
  disflow::firmware_test::Exit(1);
}

int run_tests = 0;
int failed_tests = 0;

}  // namespace

void* operator new(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) GiveUp("the tests' heap is too small");
  return memory;
}
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

// What the headers of the C++ library expect of its compiled part.
namespace std {
void __throw_length_error(const char* what) { GiveUp(what); }
void __throw_logic_error(const char* what) { GiveUp(what); }
void __throw_out_of_range_fmt(const char* what, ...) { GiveUp(what); }
void __throw_bad_function_call() { GiveUp("empty function called"); }
void __throw_bad_alloc() { GiveUp("out of memory"); }
void __throw_bad_array_new_length() { GiveUp("out of memory"); }
void __throw_invalid_argument(const char* what) { GiveUp(what); }
}  // namespace std
extern "C" {
void __cxa_pure_virtual() { GiveUp("pure virtual function called"); }
int __aeabi_atexit(void* /*object*/, void (* /*destroy*/)(void*), void* /*dso*/) { return 0; }
void* __dso_handle = nullptr;
void abort() { GiveUp("abort"); }
}

namespace testing::internal {

void Fail(const char* file, int line, const char* what) {
  ++failures;
  Print(file);
  Print(":");
  PrintNumber(line);
  Print(": ");
  Print(what);
  Print("\n");
}

void Run(const char* suite, const char* name, Test* (*make)()) {
  failures = 0;
  Test* const test = make();
  test->SetUp();
  if (failures == 0) test->TestBody();
  test->TearDown();
  delete test;
  ++run_tests;
  if (failures == 0) return;
  ++failed_tests;
  Print("FAILED: ");
  Print(suite);
  Print(".");
  Print(name);
  Print("\n");
}

}  // namespace testing::internal

int main() {
  using namespace testing::internal;
  for (const Registered* test = all; test != nullptr; test = test->next) test->run(*test);
  PrintNumber(run_tests);
  Print(" tests run, ");
  PrintNumber(failed_tests);
  Print(" failed\n");
  disflow::firmware_test::Exit(failed_tests == 0 && run_tests > 0 ? 0 : 1);
}
