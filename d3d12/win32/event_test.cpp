// SPDX-License-Identifier: MIT
#include <windows.h>
#include <wrl/event.h>

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "d3d12/com/report_fixture.h"
#include "d3d12/win32/event.h"

namespace kaamos::d3d12 {
namespace {

TEST(Event, AnAutoResetEventLetsOneWaitGo) {
  const HANDLE event = CreateEvent(nullptr, FALSE, TRUE, nullptr);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_OBJECT_0);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_TIMEOUT);
  EXPECT_TRUE(CloseHandle(event));
}

TEST(Event, AManualResetEventStaysSet) {
  const HANDLE event = CreateEvent(nullptr, TRUE, FALSE, nullptr);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_TIMEOUT);
  SetEvent(event);
  EXPECT_EQ(WaitForSingleObject(event, INFINITE), WAIT_OBJECT_0);
  EXPECT_EQ(WaitForSingleObject(event, INFINITE), WAIT_OBJECT_0);
  ResetEvent(event);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_TIMEOUT);
  CloseHandle(event);
}

TEST(Event, AWaitEndsWhenAnotherThreadSetsIt) {
  const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  std::thread other([event] { SetEvent(event); });
  EXPECT_EQ(WaitForSingleObject(event, INFINITE), WAIT_OBJECT_0);
  other.join();
  CloseHandle(event);
}

TEST(Event, OfSeveralTheFirstThatIsSetIsTold) {
  HANDLE events[3];
  for (HANDLE& event : events) event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  SetEvent(events[2]);
  EXPECT_EQ(WaitForMultipleObjects(3, events, FALSE, INFINITE), WAIT_OBJECT_0 + 2);
  EXPECT_EQ(WaitForMultipleObjects(3, events, FALSE, 0), WAIT_TIMEOUT);
  for (HANDLE event : events) SetEvent(event);
  EXPECT_EQ(WaitForMultipleObjects(3, events, TRUE, INFINITE), WAIT_OBJECT_0);
  EXPECT_EQ(WaitForSingleObject(events[1], 0), WAIT_TIMEOUT);  // the wait for all took it
  for (HANDLE event : events) CloseHandle(event);
}

TEST(Event, AClosedHandleIsAnErrorAndItsDuplicateLives) {
  const HANDLE event = CreateEvent(nullptr, TRUE, FALSE, nullptr);
  HANDLE other = nullptr;
  ASSERT_TRUE(DuplicateHandle(GetCurrentProcess(), event, GetCurrentProcess(), &other, 0, FALSE,
                              DUPLICATE_SAME_ACCESS));
  CloseHandle(event);
  const Quiet quiet;
  EXPECT_FALSE(SetEvent(event));
  EXPECT_EQ(GetLastError(), ERROR_INVALID_HANDLE);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_FAILED);
  EXPECT_TRUE(SetEvent(other));
  EXPECT_EQ(WaitForSingleObject(other, 0), WAIT_OBJECT_0);
  CloseHandle(other);
}

TEST(Clock, ItDoesNotGoBack) {
  LARGE_INTEGER before, after, frequency;
  QueryPerformanceCounter(&before);
  Sleep(1);
  QueryPerformanceCounter(&after);
  QueryPerformanceFrequency(&frequency);
  EXPECT_GE((after.QuadPart - before.QuadPart) * 1000, frequency.QuadPart);
}

// Windows lets waits go when the event is set, not when their threads run.
TEST(Event, EachSetOfAnAutoResetEventLetsOneOfTwoWaitsGo) {
  const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  for (int round = 0; round < 100; ++round) {
    std::atomic<int> let_go{0};
    const auto wait = [&] {
      if (WaitForSingleObject(event, INFINITE) == WAIT_OBJECT_0) ++let_go;
    };
    std::thread first(wait), second(wait);
    while (waiting_threads() != 2) std::this_thread::yield();
    SetEvent(event);
    SetEvent(event);
    first.join();
    second.join();
    EXPECT_EQ(let_go, 2);
  }
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_TIMEOUT);
  CloseHandle(event);
}

TEST(Event, SettingAndResettingAManualResetEventLetsAllWaitsGo) {
  const HANDLE event = CreateEvent(nullptr, TRUE, FALSE, nullptr);
  for (int round = 0; round < 100; ++round) {
    std::thread first([&] { WaitForSingleObject(event, INFINITE); });
    std::thread second([&] { WaitForSingleObject(event, INFINITE); });
    while (waiting_threads() != 2) std::this_thread::yield();
    SetEvent(event);
    ResetEvent(event);
    first.join();
    second.join();
  }
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_TIMEOUT);
  CloseHandle(event);
}

TEST(Mutex, BelongsToOneThreadAsOftenAsItWaits) {
  const HANDLE mutex = CreateMutex(nullptr, TRUE, nullptr);
  EXPECT_EQ(WaitForSingleObject(mutex, 0), WAIT_OBJECT_0);
  DWORD others_wait = 0, others_error = 0;
  std::thread([&] {
    const Quiet quiet;
    others_wait = WaitForSingleObject(mutex, 0);
    others_error = ReleaseMutex(mutex) ? 0 : GetLastError();
  }).join();
  EXPECT_EQ(others_wait, WAIT_TIMEOUT);
  EXPECT_EQ(others_error, ERROR_NOT_OWNER);

  DWORD waited = WAIT_TIMEOUT;
  std::thread other([&] {
    waited = WaitForSingleObject(mutex, INFINITE);
    ReleaseMutex(mutex);
  });
  while (waiting_threads() != 1) std::this_thread::yield();
  EXPECT_TRUE(ReleaseMutex(mutex));
  EXPECT_EQ(waiting_threads(), 1u);
  EXPECT_TRUE(ReleaseMutex(mutex));
  other.join();
  EXPECT_EQ(waited, WAIT_OBJECT_0);
  const Quiet quiet;
  EXPECT_FALSE(ReleaseMutex(mutex));
  EXPECT_FALSE(SetEvent(mutex));
  EXPECT_TRUE(CloseHandle(mutex));
  EXPECT_FALSE(ReleaseMutex(mutex));
  EXPECT_EQ(GetLastError(), DWORD{ERROR_INVALID_HANDLE});
}

// Wrappers of WRL.
TEST(Mutex, ALockEndsWithItsObject) {
  using Microsoft::WRL::Wrappers::Mutex;
  Mutex mutex(CreateMutex(nullptr, FALSE, nullptr));
  const auto locked_elsewhere = [&] {
    bool locked = false;
    std::thread([&] { locked = Mutex::Lock(mutex.Get(), 0).IsLocked(); }).join();
    return locked;
  };
  {
    const auto lock = mutex.Lock();
    EXPECT_TRUE(lock.IsLocked());
    EXPECT_FALSE(locked_elsewhere());
  }
  EXPECT_TRUE(locked_elsewhere());
}

}  // namespace
}  // namespace kaamos::d3d12
