// SPDX-License-Identifier: MIT
// kaamos-compare-renderers FIRST_1.exr FIRST_2.exr SECOND_1.exr SECOND_2.exr [RELATIVE
// [PICTURE.png]]: two pictures of each of two renderers, with different seeds. Exits with 1 where
// they differ by more than their noise and RELATIVE (0.002) of the mean, in a tile or altogether.
// PICTURE: grey where they agree, up to white where the first has 10 % more, down to black.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "compare_renderers.h"
#include "effects/assets/image/exr.h"
#include "effects/assets/image/png.h"

namespace {

kaamos::effects::Result<kaamos::effects::FloatImage> read_layer(const char* path,
                                                                const char* name) {
  const auto file = kaamos::effects::read_exr(path);
  if (!file.ok()) return file.error();
  const auto* layer = kaamos::effects::find_layer(file.value(), name);
  if (layer == nullptr)
    return kaamos::effects::make_error(kaamos::effects::ErrorId::kExr,
                                       std::string(path) + " has no layer \"" + name + "\"");
  return layer->image;
}

kaamos::effects::Result<kaamos::effects::FloatImage> read_smooth(const char* path) {
  const auto ids = read_layer(path, "ids");
  if (!ids.ok()) return ids.error();
  const auto normal = read_layer(path, "normal");
  if (!normal.ok()) return normal.error();
  return kaamos::smooth_pixels(ids.value(), normal.value());
}

int fail(const kaamos::effects::Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 2;
}

kaamos::effects::Status write_difference(const std::string& path, const kaamos::TwoHalves& first,
                                         const kaamos::TwoHalves& second) {
  kaamos::effects::ByteImage out;
  out.width = first[0].width;
  out.height = first[0].height;
  out.channels = 3;
  for (std::uint32_t i = 0; i < out.width * out.height * 3; ++i) {
    const std::uint32_t x = i / 3 % out.width, y = i / 3 / out.width, c = i % 3;
    const float a = first[0].at(x, y, c) + first[1].at(x, y, c);
    const float b = second[0].at(x, y, c) + second[1].at(x, y, c);
    const float part = a + b > 0.0f ? (a - b) / (0.5f * (a + b)) : 0.0f;
    out.values.push_back(
        static_cast<std::uint8_t>(std::clamp(127.5f + part * 1275.0f, 0.0f, 255.0f)));
  }
  return kaamos::effects::write_png(path, out);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6 || argc > 8) {
    std::fprintf(stderr, "usage: %s FIRST_1 FIRST_2 SECOND_1 SECOND_2 FRAME [RELATIVE [PICTURE]]\n",
                 argv[0]);
    return 2;
  }
  std::array<kaamos::TwoHalves, 2> pictures;
  for (int i = 0; i < 4; ++i) {
    auto read = read_layer(argv[i + 1], "");
    if (!read.ok()) return fail(read.error());
    pictures[static_cast<std::size_t>(i / 2)][static_cast<std::size_t>(i % 2)] =
        std::move(read.value());
  }
  kaamos::Allowance allowance;
  if (argc > 6) allowance.relative = std::atof(argv[6]);
  const auto smooth = read_smooth(argv[5]);
  if (!smooth.ok()) return fail(smooth.error());
  const auto found = kaamos::compare_renderers(pictures[0], pictures[1], smooth.value(), allowance);
  if (!found.ok()) return fail(found.error());
  std::printf("%s\n", kaamos::describe(found.value()).c_str());
  if (argc > 7) {
    const auto written = write_difference(argv[7], pictures[0], pictures[1]);
    if (!written.ok()) return fail(written.error());
  }
  return kaamos::agrees(found.value(), allowance) ? 0 : 1;
}
