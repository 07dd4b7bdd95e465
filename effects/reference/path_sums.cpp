// SPDX-License-Identifier: MIT
#include "effects/reference/path_sums.h"

#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "effects/assets/common/checksum.h"
#include "effects/assets/common/file.h"

namespace kaamos::effects {

namespace {

constexpr char kMagic[8] = {'K', 'A', 'A', 'M', 'O', 'S', 'P', 'T'};
constexpr std::uint32_t kVersion = 1;

struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t width, height;
  std::uint32_t seed;
  std::uint32_t samples[kPathHalves];
  std::uint64_t fingerprint;
  std::uint64_t layout;    // checksum of the layers' names and channels
  std::uint64_t checksum;  // of everything behind the header
};
static_assert(sizeof(Header) == 56);

std::uint64_t layout_of(const PathSums& sums) {
  Checksum checksum;
  for (const PathSums::Layer& layer : sums.layers) {
    checksum.add(layer.name);
    checksum.add_value(layer.channels);
  }
  return checksum.value();
}

std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.value();
}

Error refused(const std::string& path, const std::string& what) {
  return make_error(ErrorId::kPathSums, "\"" + path + "\": " + what);
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// Returns what in the header does not fit what is wanted; empty: all fits.
std::string misfit(const Header& header, const PathSums& wanted) {
  if (header.width != wanted.width || header.height != wanted.height) {
    return "it holds a picture of " + size_text(header.width, header.height) + ", not of " +
           size_text(wanted.width, wanted.height);
  }
  if (header.seed != wanted.seed) {
    return "its seed is " + std::to_string(header.seed) + ", not " + std::to_string(wanted.seed);
  }
  if (header.fingerprint != wanted.fingerprint) {
    return "it is of another scene, camera or number of bounces";
  }
  if (header.layout != layout_of(wanted)) return "it has other layers";
  return {};
}

}  // namespace

void PathSums::add_layer(std::string name, std::uint32_t channels) {
  Layer layer;
  layer.name = std::move(name);
  layer.channels = channels;
  const std::size_t size = static_cast<std::size_t>(width) * height * channels;
  for (auto& sums : layer.sums) sums.assign(size, 0.0);
  layers.push_back(std::move(layer));
}

FloatImage PathSums::mean(const Layer& layer) const {
  FloatImage out(width, height, layer.channels);
  const double scale = 1.0 / (static_cast<double>(samples[0]) + samples[1]);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = static_cast<float>((layer.sums[0][i] + layer.sums[1][i]) * scale);
  }
  return out;
}

double PathSums::error(const Layer& layer) const {
  if (samples[0] == 0 || samples[1] == 0) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < layer.sums[0].size(); ++i) {
    const double half = 0.5 * (layer.sums[0][i] / samples[0] - layer.sums[1][i] / samples[1]);
    sum += half * half;
  }
  return std::sqrt(sum / static_cast<double>(layer.sums[0].size()));
}

const PathSums::Layer* PathSums::find(const std::string& name) const {
  for (const Layer& layer : layers) {
    if (layer.name == name) return &layer;
  }
  return nullptr;
}

Status save_path_sums(const std::string& path, const PathSums& sums) {
  std::vector<std::uint8_t> bytes(sizeof(Header));
  for (const PathSums::Layer& layer : sums.layers) {
    for (const auto& half : layer.sums) {
      const auto* begin = reinterpret_cast<const std::uint8_t*>(half.data());
      bytes.insert(bytes.end(), begin, begin + half.size() * sizeof(double));
    }
  }
  Header header = {};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.width = sums.width;
  header.height = sums.height;
  header.seed = sums.seed;
  for (std::uint32_t half = 0; half < kPathHalves; ++half)
    header.samples[half] = sums.samples[half];
  header.fingerprint = sums.fingerprint;
  header.layout = layout_of(sums);
  header.checksum = checksum_of(std::span(bytes).subspan(sizeof(Header)));
  std::memcpy(bytes.data(), &header, sizeof(header));
  return write_file(path, bytes);
}

Status load_path_sums(const std::string& path, PathSums& wanted) {
  const auto read = read_file(path);
  if (!read.ok()) return read.error();
  const std::vector<std::uint8_t>& bytes = read.value();
  Header header;
  if (bytes.size() < sizeof(header)) {
    return refused(path, "it has " + std::to_string(bytes.size()) + " bytes, less than a header");
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) {
    return refused(path, "it begins with other letters than KAAMOSPT");
  }
  if (header.version != kVersion) {
    return refused(path, "its version is " + std::to_string(header.version) +
                             ", this program reads " + std::to_string(kVersion));
  }
  if (const std::string what = misfit(header, wanted); !what.empty()) return refused(path, what);
  std::size_t size = sizeof(header);
  for (const PathSums::Layer& layer : wanted.layers) {
    size += kPathHalves * layer.sums[0].size() * sizeof(double);
  }
  if (bytes.size() != size) {
    return refused(path, "it has " + std::to_string(bytes.size()) + " bytes instead of " +
                             std::to_string(size));
  }
  if (header.checksum != checksum_of(std::span(bytes).subspan(sizeof(header)))) {
    return refused(path, "its checksum is another one: it is damaged");
  }
  const std::uint8_t* at = bytes.data() + sizeof(header);
  for (PathSums::Layer& layer : wanted.layers) {
    for (auto& half : layer.sums) {
      std::memcpy(half.data(), at, half.size() * sizeof(double));
      at += half.size() * sizeof(double);
    }
  }
  for (std::uint32_t half = 0; half < kPathHalves; ++half) {
    wanted.samples[half] = header.samples[half];
  }
  return {};
}

}  // namespace kaamos::effects
