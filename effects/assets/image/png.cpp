// SPDX-License-Identifier: MIT
#include "effects/assets/image/png.h"

#include <png.h>

#include <cstring>

#include "effects/assets/common/file.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kMaxSide = 65535;

/// libpng's simplified interface has state of its own; this frees it on every path out.
class PngImage {
 public:
  PngImage() {
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
  }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&image); }

  png_image image;
};

Status check(const ByteImage& image) {
  if (image.width == 0 || image.height == 0 || image.width > kMaxSide || image.height > kMaxSide)
    return make_error(ErrorId::kPng, "a picture of " + std::to_string(image.width) + " x " +
                                         std::to_string(image.height) + " pixels, sides of 1.." +
                                         std::to_string(kMaxSide) + " are allowed");
  if (image.channels != 1 && image.channels != 3 && image.channels != 4)
    return make_error(ErrorId::kPng, "a picture of " + std::to_string(image.channels) +
                                         " channels, 1, 3 and 4 are allowed");
  const std::size_t wanted = std::size_t{image.width} * image.height * image.channels;
  if (image.values.size() != wanted)
    return make_error(ErrorId::kPng, "a picture of " + std::to_string(image.values.size()) +
                                         " bytes, " + std::to_string(wanted) + " are needed");
  return {};
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_png(const ByteImage& image) {
  const Status status = check(image);
  if (!status.ok()) return status.error();
  PngImage png;
  png.image.width = image.width;
  png.image.height = image.height;
  png.image.format = image.channels == 1   ? PNG_FORMAT_GRAY
                     : image.channels == 3 ? PNG_FORMAT_RGB
                                           : PNG_FORMAT_RGBA;
  png.image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::vector<std::uint8_t> bytes(size);
  if (!png_image_write_to_memory(&png.image, bytes.data(), &size, 0, image.values.data(), 0,
                                 nullptr))
    return make_error(ErrorId::kPng, png.image.message);
  bytes.resize(size);
  return bytes;
}

Status write_png(const std::string& path, const ByteImage& image) {
  const Result<std::vector<std::uint8_t>> bytes = encode_png(image);
  if (!bytes.ok()) return within("\"" + path + "\"", bytes.error(), ErrorId::kPng);
  return write_file(path, bytes.value());
}

Result<ByteImage> read_png(const std::string& path) {
  const Result<std::vector<std::uint8_t>> bytes = read_file(path);
  if (!bytes.ok()) return bytes.error();
  PngImage png;
  const auto failed = [&](const char* reason) {
    return make_error(ErrorId::kPng, "\"" + path + "\": " + reason);
  };
  if (!png_image_begin_read_from_memory(&png.image, bytes.value().data(), bytes.value().size()))
    return failed(png.image.message);
  if (png.image.width > kMaxSide || png.image.height > kMaxSide) return failed("is too large");
  png.image.format = PNG_FORMAT_RGBA;
  ByteImage image;
  image.width = png.image.width;
  image.height = png.image.height;
  image.channels = 4;
  image.values.resize(std::size_t{image.width} * image.height * 4);
  if (!png_image_finish_read(&png.image, nullptr, image.values.data(), 0, nullptr))
    return failed(png.image.message);
  return image;
}

}  // namespace kaamos::effects
