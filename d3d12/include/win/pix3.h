// SPDX-License-Identifier: MIT
// Events of PIX, as markers of queues and lists; messages of checked mode name them.
// [WinPixEventRuntime: pix3.h]
#pragma once

#include <stdint.h>
#include <stdio.h>

#include <string>

#include <kaamos_crt.h>

#define PIX_COLOR(r, g, b) ((uint32_t)(0xff000000u | ((r) << 16) | ((g) << 8) | (b)))
#define PIX_COLOR_INDEX(i) ((uint32_t)(i))
#define PIX_COLOR_DEFAULT PIX_COLOR_INDEX(0)

extern "C++" {
// Metadata 0 of BeginEvent and SetMarker is a wide text, 1 a narrow one.
template <class... Arguments>
std::string kaamos_pix_text(const char* format, Arguments... arguments) {
  char text[512] = {};
  _snprintf_s(text, 512, _TRUNCATE, format, arguments...);
  return text;
}
template <class... Arguments>
std::wstring kaamos_pix_text(const wchar_t* format, Arguments... arguments) {
  wchar_t text[512] = {};
  _snwprintf_s(text, 512, _TRUNCATE, format, arguments...);
  return text;
}
template <class C, class... Arguments>
void PIXBeginEvent(C* context, uint64_t, const char* format, Arguments... arguments) {
  const std::string text = kaamos_pix_text(format, arguments...);
  context->BeginEvent(1, text.c_str(), (unsigned)text.size() + 1);
}
template <class C, class... Arguments>
void PIXBeginEvent(C* context, uint64_t, const wchar_t* format, Arguments... arguments) {
  const std::wstring text = kaamos_pix_text(format, arguments...);
  context->BeginEvent(0, text.c_str(), (unsigned)((text.size() + 1) * sizeof(wchar_t)));
}
template <class C, class... Arguments>
void PIXSetMarker(C* context, uint64_t, const char* format, Arguments... arguments) {
  const std::string text = kaamos_pix_text(format, arguments...);
  context->SetMarker(1, text.c_str(), (unsigned)text.size() + 1);
}
template <class C, class... Arguments>
void PIXSetMarker(C* context, uint64_t, const wchar_t* format, Arguments... arguments) {
  const std::wstring text = kaamos_pix_text(format, arguments...);
  context->SetMarker(0, text.c_str(), (unsigned)((text.size() + 1) * sizeof(wchar_t)));
}
template <class C>
void PIXEndEvent(C* context) {
  context->EndEvent();
}
// Events of the processor have no list to go into.
template <class... Arguments>
void PIXBeginEvent(uint64_t, const char*, Arguments...) {}
template <class... Arguments>
void PIXBeginEvent(uint64_t, const wchar_t*, Arguments...) {}
inline void PIXEndEvent() {}

template <class C>
class PIXScopedEventObject {
 public:
  template <class... Arguments>
  explicit PIXScopedEventObject(C* context, uint64_t color, Arguments... arguments)
      : context_(context) {
    PIXBeginEvent(context, color, arguments...);
  }
  PIXScopedEventObject(const PIXScopedEventObject&) = delete;
  PIXScopedEventObject& operator=(const PIXScopedEventObject&) = delete;
  ~PIXScopedEventObject() { PIXEndEvent(context_); }

 private:
  C* context_;
};
}
#define KAAMOS_PIX_NAME2(line) kaamos_pix_event_##line
#define KAAMOS_PIX_NAME(line) KAAMOS_PIX_NAME2(line)
#define PIXScopedEvent(context, ...) \
  PIXScopedEventObject KAAMOS_PIX_NAME(__LINE__)(&*(context), __VA_ARGS__)
