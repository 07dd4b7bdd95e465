// SPDX-License-Identifier: MIT
#include "effects/assets/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/assets/common/parallel.h"

namespace kaamos::effects {
namespace {

/// Lets OpenEXR write into memory, so that the file appears as a whole or not at all.
class MemoryOut : public Imf::OStream {
 public:
  MemoryOut() : Imf::OStream("memory") {}
  void write(const char c[], int n) override {
    const std::size_t size = static_cast<std::size_t>(n);
    if (position_ + size > bytes.size()) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, c, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<std::uint8_t> bytes;

 private:
  std::size_t position_ = 0;
};

class MemoryIn : public Imf::IStream {
 public:
  MemoryIn(const std::vector<std::uint8_t>& bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}
  bool read(char c[], int n) override {
    const std::size_t size = static_cast<std::size_t>(n);
    if (n < 0 || position_ > bytes_.size() || size > bytes_.size() - position_)
      throw std::runtime_error("the file is cut");
    std::memcpy(c, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t position_ = 0;
};

std::vector<std::string> channel_names(const ExrLayer& layer) {
  if (!layer.channels.empty()) return layer.channels;
  switch (layer.image.channels) {
    case 1:
      return {"Y"};
    case 2:
      return {"X", "Y"};
    case 3:
      return {"R", "G", "B"};
    case 4:
      return {"R", "G", "B", "A"};
    default: {
      std::vector<std::string> names;
      for (std::uint32_t c = 0; c < layer.image.channels; ++c)
        names.push_back("C" + std::to_string(c));
      return names;
    }
  }
}

std::string full_name(const std::string& layer, const std::string& channel) {
  return layer.empty() ? channel : layer + "." + channel;
}

Status check(const ExrFile& file) {
  if (file.layers.empty()) return make_error(ErrorId::kExr, "has no layer");
  const FloatImage& first = file.layers[0].image;
  for (std::size_t i = 0; i < file.layers.size(); ++i) {
    const ExrLayer& layer = file.layers[i];
    const std::string where = "layer \"" + layer.name + "\"";
    const FloatImage& image = layer.image;
    if (image.width == 0 || image.height == 0 || image.channels == 0)
      return make_error(ErrorId::kExr, where + ": is empty");
    if (image.width != first.width || image.height != first.height)
      return make_error(ErrorId::kExr,
                        where + ": is " + std::to_string(image.width) + " x " +
                            std::to_string(image.height) + " pixels, the first layer is " +
                            std::to_string(first.width) + " x " + std::to_string(first.height));
    if (image.values.size() != std::size_t{image.width} * image.height * image.channels)
      return make_error(ErrorId::kExr, where + ": its values do not fill its size");
    if (channel_names(layer).size() != image.channels)
      return make_error(ErrorId::kExr, where + ": has " + std::to_string(layer.channels.size()) +
                                           " channel names for " + std::to_string(image.channels) +
                                           " channels");
    for (std::size_t j = 0; j < i; ++j)
      if (file.layers[j].name == layer.name)
        return make_error(ErrorId::kExr, where + ": occurs twice");
  }
  return {};
}

// OpenEXR's threads belong to the process.
class ExrThreads {
 public:
  explicit ExrThreads(int count) : before_(Imf::globalThreadCount()) {
    if (count > before_) Imf::setGlobalThreadCount(count);
  }
  ~ExrThreads() {
    if (Imf::globalThreadCount() != before_) Imf::setGlobalThreadCount(before_);
  }
  ExrThreads(const ExrThreads&) = delete;
  ExrThreads& operator=(const ExrThreads&) = delete;

 private:
  int before_;
};

// `threads`: 0 or 1: the caller's alone.
std::vector<std::uint8_t> encode(const ExrFile& file, int threads) {
  const FloatImage& first = file.layers[0].image;
  Imf::Header header(static_cast<int>(first.width), static_cast<int>(first.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, text] : file.attributes) header.insert(key, Imf::StringAttribute(text));
  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> halves(file.layers.size());
  for (std::size_t i = 0; i < file.layers.size(); ++i) {
    const ExrLayer& layer = file.layers[i];
    const Imf::PixelType type = layer.half ? Imf::HALF : Imf::FLOAT;
    const std::size_t size = layer.half ? sizeof(half) : sizeof(float);
    const std::size_t pixel = layer.image.channels * size;
    if (layer.half) halves[i].assign(layer.image.values.begin(), layer.image.values.end());
    // The frame buffer wants a non-const pointer although it only reads.
    char* base = layer.half
                     ? reinterpret_cast<char*>(halves[i].data())
                     : const_cast<char*>(reinterpret_cast<const char*>(layer.image.values.data()));
    const std::vector<std::string> names = channel_names(layer);
    for (std::size_t c = 0; c < names.size(); ++c) {
      const std::string name = full_name(layer.name, names[c]);
      header.channels().insert(name, Imf::Channel(type));
      frame.insert(name, Imf::Slice(type, base + c * size, pixel, pixel * first.width));
    }
  }
  MemoryOut stream;
  {
    const ExrThreads held(threads);
    Imf::OutputFile out(stream, header, threads);
    out.setFrameBuffer(frame);
    out.writePixels(static_cast<int>(first.height));
  }
  return std::move(stream.bytes);
}

/// Position of a channel within its layer.
int channel_rank(const std::string& name) {
  static const char* const order[] = {"R", "G", "B", "A", "X", "Y", "Z"};
  for (int i = 0; i < 7; ++i)
    if (name == order[i]) return i;
  return 7;
}

/// Names of the layers with their channels, in the order of the file format (alphabetical).
std::vector<ExrLayer> layers_of(const Imf::Header& header) {
  std::map<std::string, ExrLayer> layers;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const std::string full = c.name();
    const std::size_t dot = full.rfind('.');
    const std::string name = dot == std::string::npos ? "" : full.substr(0, dot);
    ExrLayer& layer = layers[name];
    layer.name = name;
    layer.half = c.channel().type == Imf::HALF;
    layer.channels.push_back(dot == std::string::npos ? full : full.substr(dot + 1));
  }
  std::vector<ExrLayer> out;
  for (auto& [name, layer] : layers) {
    std::stable_sort(layer.channels.begin(), layer.channels.end(),
                     [](const std::string& a, const std::string& b) {
                       return channel_rank(a) < channel_rank(b);
                     });
    out.push_back(std::move(layer));
  }
  return out;
}

ExrFile decode(const std::vector<std::uint8_t>& bytes, const std::string& path) {
  MemoryIn stream(bytes, path);
  Imf::InputFile in(stream);
  const Imath::Box2i window = in.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  // A compressed byte can hold no more than a few thousand pixels, but a broken header can claim
  // any size.
  if (width < 1 || height < 1 || width > 65536 || height > 65536)
    throw std::runtime_error("its size is " + std::to_string(width) + " x " +
                             std::to_string(height) + ", sides of 1..65536 are allowed");
  ExrFile file;
  file.layers = layers_of(in.header());
  Imf::FrameBuffer frame;
  for (ExrLayer& layer : file.layers) {
    layer.image = FloatImage(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                             static_cast<std::uint32_t>(layer.channels.size()));
    const std::size_t pixel = layer.channels.size() * sizeof(float);
    for (std::size_t c = 0; c < layer.channels.size(); ++c)
      frame.insert(full_name(layer.name, layer.channels[c]),
                   Imf::Slice::Make(Imf::FLOAT, layer.image.values.data() + c, window, pixel,
                                    pixel * static_cast<std::size_t>(width)));
  }
  in.setFrameBuffer(frame);
  in.readPixels(window.min.y, window.max.y);
  for (auto a = in.header().begin(); a != in.header().end(); ++a)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
      file.attributes[a.name()] = text->value();
  return file;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_exr(const ExrFile& file, std::uint32_t threads) {
  if (const Status status = check(file); !status.ok()) return status.error();
  try {
    const std::uint32_t count = thread_count(threads);
    return encode(file, count > 1 ? static_cast<int>(count) : 0);
  } catch (const std::exception& error) {
    return make_error(ErrorId::kExr, error.what());
  }
}

Status write_exr(const std::string& path, const ExrFile& file) {
  const auto bytes = encode_exr(file);
  if (!bytes.ok()) return within("\"" + path + "\"", bytes.error(), ErrorId::kExr);
  return write_file(path, bytes.value());
}

Result<ExrFile> read_exr(const std::string& path) {
  const Result<std::vector<std::uint8_t>> bytes = read_file(path);
  if (!bytes.ok()) return bytes.error();
  try {
    return decode(bytes.value(), path);
  } catch (const std::exception& error) {
    return make_error(ErrorId::kExr, "\"" + path + "\": " + error.what());
  }
}

const ExrLayer* find_layer(const ExrFile& file, const std::string& name) {
  for (const ExrLayer& layer : file.layers)
    if (layer.name == name) return &layer;
  return nullptr;
}

}  // namespace kaamos::effects
