// SPDX-License-Identifier: MIT
#include "d3d12/win32/window.h"

#include <xinput.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "d3d12/com/report_fixture.h"

namespace kaamos::d3d12 {
namespace {

using testing::ElementsAre;

std::vector<UINT> told;
bool validates = false;

LRESULT CALLBACK procedure(HWND window, UINT message, WPARAM wparam, LPARAM lparam) {
  told.push_back(message);
  switch (message) {
    case WM_CREATE:
      return reinterpret_cast<LPCREATESTRUCT>(lparam)->lpCreateParams == &told ? 0 : -1;
    case WM_PAINT:
      if (validates) ValidateRect(window, nullptr);
      return 0;
    case WM_DESTROY:
      PostQuitMessage(5);
      return 0;
    default:
      return DefWindowProc(window, message, wparam, lparam);
  }
}

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    told.clear();
    validates = false;
    WNDCLASSEX window_class = {};
    window_class.cbSize = sizeof(window_class);
    window_class.lpfnWndProc = &procedure;
    window_class.lpszClassName = "Test";
    ASSERT_NE(RegisterClassEx(&window_class), 0);
    window_ = CreateWindow("Test", "a title", WS_OVERLAPPEDWINDOW, CW_USEDEFAULT, CW_USEDEFAULT,
                           640, 360, nullptr, nullptr, nullptr, &told);
    ASSERT_NE(window_, nullptr);
  }
  void TearDown() override {
    if (IsWindow(window_)) DestroyWindow(window_);
    MSG message;
    while (PeekMessage(&message, nullptr, 0, 0, PM_REMOVE)) {
    }
    UnregisterClass("Test", nullptr);
  }

  HWND window_ = nullptr;
};

TEST_F(WindowTest, IsToldWhatWindowsTells) {
  EXPECT_THAT(told, ElementsAre(WM_NCCREATE, WM_CREATE));
  told.clear();
  EXPECT_FALSE(ShowWindow(window_, SW_SHOW));
  EXPECT_THAT(
      told, ElementsAre(WM_SHOWWINDOW, WM_ACTIVATEAPP, WM_ACTIVATE, WM_SETFOCUS, WM_SIZE, WM_MOVE));
  told.clear();
  EXPECT_TRUE(DestroyWindow(window_));
  EXPECT_THAT(told, ElementsAre(WM_DESTROY, WM_NCDESTROY));
  EXPECT_FALSE(IsWindow(window_));
}

TEST_F(WindowTest, HasTheSizeThatItsProgramAskedFor) {
  RECT rect = {};
  EXPECT_TRUE(GetClientRect(window_, &rect));
  EXPECT_EQ(rect.right, 640);
  EXPECT_EQ(rect.bottom, 360);
  told.clear();
  EXPECT_TRUE(SetWindowPos(window_, nullptr, 0, 0, 320, 180, SWP_NOMOVE));
  EXPECT_THAT(told, ElementsAre(WM_SIZE));
  const auto size = window_size(window_);
  ASSERT_TRUE(size.has_value());
  EXPECT_EQ(size->cx, 320);
  EXPECT_EQ(size->cy, 180);
  char title[4];
  EXPECT_EQ(GetWindowText(window_, title, 4), 3);
  EXPECT_STREQ(title, "a t");
}

TEST_F(WindowTest, PaintsAgainAndAgainUntilItIsValid) {
  ShowWindow(window_, SW_SHOW);
  MSG message = {};
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(PeekMessage(&message, nullptr, 0, 0, PM_REMOVE));
    EXPECT_EQ(message.message, UINT{WM_PAINT});
    DispatchMessage(&message);
  }
  validates = true;
  DispatchMessage(&message);
  EXPECT_FALSE(PeekMessage(&message, nullptr, 0, 0, PM_REMOVE));
  // A program that waits is asked to paint again: there is no other message that could come.
  EXPECT_TRUE(GetMessage(&message, nullptr, 0, 0));
  EXPECT_EQ(message.message, UINT{WM_PAINT});
}

TEST_F(WindowTest, IsClosedAfterTheLastFrame) {
  ShowWindow(window_, SW_SHOW);
  const int frames = frame_limit();
  int presented = 0;
  MSG message = {};
  while (message.message != WM_QUIT && presented < 100) {
    if (PeekMessage(&message, nullptr, 0, 0, PM_REMOVE)) {
      TranslateMessage(&message);
      DispatchMessage(&message);
      if (message.message == WM_PAINT) count_frame(window_), ++presented;
    }
  }
  EXPECT_EQ(presented, frames);
  EXPECT_EQ(message.wParam, WPARAM{5});
  EXPECT_FALSE(IsWindow(window_));
}

TEST_F(WindowTest, AnotherThreadsMessageEndsAWait) {
  std::thread other([this] { PostMessage(window_, WM_APP + 1, 2, 3); });
  MSG message = {};
  EXPECT_TRUE(GetMessage(&message, window_, WM_APP, WM_APP + 9));
  EXPECT_EQ(message.wParam, WPARAM{2});
  EXPECT_EQ(message.lParam, 3);
  other.join();
}

TEST_F(WindowTest, KeepsItsProgramsValues) {
  EXPECT_EQ(SetWindowLongPtr(window_, GWLP_USERDATA, 42), 0);
  EXPECT_EQ(GetWindowLongPtr(window_, GWLP_USERDATA), 42);
  EXPECT_EQ(GetWindowLongPtr(window_, GWL_STYLE), WS_OVERLAPPEDWINDOW);
}

TEST_F(WindowTest, WrongCallsAreErrors) {
  const Quiet quiet;
  const Listener listener;
  WNDCLASS again = {};
  again.lpfnWndProc = &procedure;
  again.lpszClassName = "Test";
  EXPECT_EQ(RegisterClass(&again), 0);
  EXPECT_EQ(GetLastError(), ERROR_CLASS_ALREADY_EXISTS);
  EXPECT_EQ(CreateWindow("None", "", 0, 0, 0, 1, 1, nullptr, nullptr, nullptr, nullptr), nullptr);
  EXPECT_EQ(GetLastError(), ERROR_CANNOT_FIND_WND_CLASS);
  // WM_CREATE's -1 ends the creation.
  EXPECT_EQ(CreateWindow("Test", "", 0, 0, 0, 1, 1, nullptr, nullptr, nullptr, nullptr), nullptr);
  RECT rect = {};
  EXPECT_FALSE(GetClientRect(reinterpret_cast<HWND>(2), &rect));
  EXPECT_EQ(GetLastError(), ERROR_INVALID_WINDOW_HANDLE);
  EXPECT_THAT(listener.messages, testing::SizeIs(3));
  EXPECT_THAT(listener.messages[1], testing::HasSubstr("there is no class None"));
}

TEST(Window, NamesOfOneTextTypeAreFunctions) {
  WNDCLASSW kind = {};
  kind.lpfnWndProc = DefWindowProcW;
  kind.lpszClassName = L"wide names";
  ASSERT_NE(RegisterClassW(&kind), 0);
  const HWND window = CreateWindowW(L"wide names", L"title", WS_OVERLAPPEDWINDOW, 0, 0, 64, 64,
                                    nullptr, nullptr, nullptr, nullptr);
  ASSERT_NE(window, nullptr);
  EXPECT_FALSE(IsIconic(window));
  EXPECT_FALSE(IsZoomed(window));
  EXPECT_EQ(MonitorFromPoint({10, 10}, MONITOR_DEFAULTTONEAREST),
            MonitorFromWindow(window, MONITOR_DEFAULTTONEAREST));
  EXPECT_TRUE(DestroyWindow(window));
}

TEST_F(WindowTest, ClosingAClosedWindowIsNoError) {
  const Listener listener;
  EXPECT_TRUE(DestroyWindow(window_));
  EXPECT_FALSE(DestroyWindow(window_));
  EXPECT_EQ(GetLastError(), DWORD{ERROR_INVALID_WINDOW_HANDLE});
  EXPECT_THAT(listener.messages, testing::IsEmpty());
}

TEST(Desktop, HasTheSizeOfTheScreen) {
  RECT rect = {};
  ASSERT_TRUE(GetWindowRect(GetDesktopWindow(), &rect));
  EXPECT_EQ(rect.right, GetSystemMetrics(SM_CXSCREEN));
  EXPECT_EQ(rect.bottom, GetSystemMetrics(SM_CYVIRTUALSCREEN));
  EXPECT_TRUE(GetClientRect(GetDesktopWindow(), &rect));
  EXPECT_EQ(rect.right, GetDeviceCaps(GetDC(nullptr), HORZRES));
}

TEST(Desktop, HasNoImagesAndNoInput) {
  EXPECT_EQ(LoadImageW(nullptr, L"none.ico", IMAGE_ICON, 0, 0, LR_LOADFROMFILE), nullptr);
  EXPECT_EQ(GetLastError(), DWORD{ERROR_FILE_NOT_FOUND});
  EXPECT_EQ(LoadImage(nullptr, MAKEINTRESOURCE(1), IMAGE_ICON, 0, 0, LR_DEFAULTSIZE), nullptr);
  EXPECT_EQ(GetLastError(), DWORD{ERROR_RESOURCE_TYPE_NOT_FOUND});
  BYTE keys[256] = {1};
  EXPECT_TRUE(GetKeyboardState(keys));
  EXPECT_EQ(keys[0], 0);
  CURSORINFO cursor = {};
  cursor.flags = CURSOR_SHOWING;
  EXPECT_TRUE(GetCursorInfo(&cursor));
  EXPECT_EQ(cursor.flags, 0u);
  UINT size = 0;
  EXPECT_EQ(GetRawInputData(nullptr, RID_INPUT, nullptr, &size, sizeof(RAWINPUTHEADER)), UINT_MAX);
  XINPUT_STATE pad = {};
  EXPECT_EQ(XInputGetState(0, &pad), ERROR_DEVICE_NOT_CONNECTED);
}

}  // namespace
}  // namespace kaamos::d3d12
