// SPDX-License-Identifier: MIT
#include "d3d12/dxgi/frame.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string>

#include "effects/assets/image/png.h"
#include "effects/assets/image/srgb.h"

namespace kaamos::d3d12 {

namespace {

struct Callback {
  KaamosPresentCallback function = nullptr;
  void* user = nullptr;
};
std::mutex callback_mutex;
Callback current_callback;

Callback callback() {
  std::scoped_lock lock(callback_mutex);
  return current_callback;
}

const char* folder() {
  const char* out = std::getenv("KAAMOS_PRESENT");
  return out != nullptr && *out != '\0' ? out : nullptr;
}

UINT64 every() {
  const char* text = std::getenv("KAAMOS_PRESENT_EVERY");
  if (text == nullptr) return 1;
  char* end = nullptr;
  const unsigned long long out = std::strtoull(text, &end, 10);
  if (*text >= '0' && *text <= '9' && *end == '\0' && out > 0) return out;
  static std::once_flag told;
  std::call_once(told, [&] {
    process_reporter().fail(ErrorId::kPresent,
                            "KAAMOS_PRESENT_EVERY is \"" + std::string(text) +
                                "\"; it is a whole number from 1 on. Every frame is written.");
  });
  return 1;
}

float half_to_float(uint16_t half) {
  const int exponent = half >> 10 & 31, fraction = half & 1023;
  float value = exponent == 0 ? std::ldexp(static_cast<float>(fraction), -24)
                              : std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
  if (exponent == 31) value = fraction == 0 ? INFINITY : NAN;
  return (half & 0x8000) != 0 ? -value : value;
}

// NaN is black.
uint8_t srgb_byte(float linear) {
  if (!(linear > 0)) return 0;
  const float encoded = effects::srgb_from_linear(std::min(linear, 1.0F));
  return static_cast<uint8_t>(std::lround(encoded * 255));
}

// One pixel as three bytes.
void convert(DXGI_FORMAT format, const uint8_t* pixel, uint8_t* rgb) {
  uint32_t word;
  uint16_t halves[3];
  switch (format) {
    case DXGI_FORMAT_B8G8R8A8_UNORM:
      for (int i = 0; i < 3; ++i) rgb[i] = pixel[2 - i];
      break;
    case DXGI_FORMAT_R10G10B10A2_UNORM:
      std::memcpy(&word, pixel, sizeof(word));
      for (int i = 0; i < 3; ++i) {
        rgb[i] = static_cast<uint8_t>(((word >> (10 * i) & 1023) * 255 + 511) / 1023);
      }
      break;
    case DXGI_FORMAT_R16G16B16A16_FLOAT:
      std::memcpy(halves, pixel, sizeof(halves));
      for (int i = 0; i < 3; ++i) rgb[i] = srgb_byte(half_to_float(halves[i]));
      break;
    default:  // R8G8B8A8_UNORM
      std::copy(pixel, pixel + 3, rgb);
  }
}

effects::ByteImage convert(const KaamosFrame& frame) {
  const size_t pixel_bytes = frame.format == DXGI_FORMAT_R16G16B16A16_FLOAT ? 8 : 4;
  effects::ByteImage out = {frame.width, frame.height, 3, {}};
  out.values.resize(size_t{3} * frame.width * frame.height);
  for (size_t y = 0; y < frame.height; ++y) {
    const uint8_t* row = static_cast<const uint8_t*>(frame.pixels) + y * frame.row_bytes;
    for (size_t x = 0; x < frame.width; ++x) {
      convert(frame.format, row + x * pixel_bytes, &out.values[3 * (y * frame.width + x)]);
    }
  }
  return out;
}

rtapi::Status write_png(const std::filesystem::path& path, const KaamosFrame& frame) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  const rtapi::Status written = effects::write_png(path.string(), convert(frame));
  return written.ok() ? written : make_error(ErrorId::kPresent, written.error().message);
}

}  // namespace

bool wants_frame(UINT64 number) {
  return callback().function != nullptr || (folder() != nullptr && number % every() == 0);
}

rtapi::Status deliver_frame(const KaamosFrame& frame, UINT chain) {
  const Callback to = callback();
  if (to.function != nullptr) to.function(&frame, to.user);
  if (folder() == nullptr || frame.number % every() != 0) return {};
  std::string name = std::to_string(frame.number);
  name = "frame_" + std::string(name.size() < 5 ? 5 - name.size() : 0, '0') + name + ".png";
  if (chain > 1) name = "chain" + std::to_string(chain) + "_" + name;
  return write_png(std::filesystem::path(folder()) / name, frame);
}

}  // namespace kaamos::d3d12

extern "C" void kaamos_on_present(KaamosPresentCallback callback, void* user) {
  std::scoped_lock lock(kaamos::d3d12::callback_mutex);
  kaamos::d3d12::current_callback = {callback, user};
}
