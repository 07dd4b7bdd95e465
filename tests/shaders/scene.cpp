// SPDX-License-Identifier: MIT
#include "tests/shaders/scene.h"

#include <rtapi/upload.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "tests/common/structures.h"

namespace kaamos::shader_tests {
namespace {

// The words of a line; "(1, 2, 3)" is one word without its brackets.
struct Word {
  std::string text;
  bool is_list = false;
};

std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> out;
  for (size_t i = 0; i < line.size();) {
    if (std::isspace(static_cast<unsigned char>(line[i])) != 0) {
      ++i;
      continue;
    }
    if (line.substr(i).starts_with("//")) break;
    if (line[i] == '(') {
      const size_t end = std::min(line.find(')', i), line.size());
      out.push_back({std::string(line.substr(i + 1, end - i - 1)), true});
      i = end + 1;
      continue;
    }
    size_t end = i;
    while (end < line.size() && std::isspace(static_cast<unsigned char>(line[end])) == 0 &&
           line[end] != '(') {
      ++end;
    }
    out.push_back({std::string(line.substr(i, end - i)), false});
    i = end;
  }
  return out;
}

std::optional<float> float_of(const std::string& text) {
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  while (end != nullptr && std::isspace(static_cast<unsigned char>(*end)) != 0) ++end;
  if (end == text.c_str() || *end != 0) return std::nullopt;
  return value;
}

std::optional<uint32_t> number_of(const std::string& text) {
  char* end = nullptr;
  const unsigned long value = std::strtoul(text.c_str(), &end, 0);
  if (end == text.c_str() || *end != 0 || text[0] == '-') return std::nullopt;
  return static_cast<uint32_t>(value);
}

// "1, 2, 3"; empty unless there are `count`.
std::vector<float> floats_of(const std::string& list, size_t count) {
  std::vector<float> out;
  size_t at = 0;
  while (at <= list.size()) {
    const size_t comma = std::min(list.find(',', at), list.size());
    const auto value = float_of(list.substr(at, comma - at));
    if (!value) return {};
    out.push_back(*value);
    at = comma + 1;
  }
  return out.size() == count ? out : std::vector<float>();
}

class SceneReader {
 public:
  explicit SceneReader(SceneDescription& out) : out_(out) {}

  void read_line(const std::vector<Word>& words, uint32_t line) {
    words_ = &words;
    line_ = line;
    const std::string what = words.size() > 2 ? words[2].text : "";
    if (words.size() < 4 || (what != "geometry" && what != "instance")) {
      return fail("'#pragma kaamos " + what +
                  "' is none; write '#pragma kaamos geometry NAME ...' or '#pragma kaamos "
                  "instance NAME ...'");
    }
    what == "geometry" ? geometry() : instance();
  }

 private:
  void geometry() {
    SceneGeometry made;
    made.bottom_level = (*words_)[3].text;
    std::string kind;
    for (size_t i = 4; i < words_->size(); ++i) {
      const Word& word = (*words_)[i];
      if (word.is_list) {
        const std::vector<float> point = floats_of(word.text, 3);
        if (point.empty()) return fail("'(" + word.text + ")' is not three numbers");
        made.points.insert(made.points.end(), point.begin(), point.end());
      } else if (word.text == "triangles" || word.text == "boxes") {
        kind = word.text;
      } else if (word.text == "opaque") {
        made.flags = made.flags | rtapi::RaytracingGeometryFlags::kOpaque;
      } else if (word.text == "no_duplicate_anyhit") {
        made.flags = made.flags | rtapi::RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
      } else {
        return fail("'" + word.text +
                    "' is neither triangles, boxes, opaque, no_duplicate_anyhit nor a point");
      }
    }
    if (kind.empty()) return fail("a geometry is triangles or boxes");
    made.is_boxes = kind == "boxes";
    const size_t each = made.is_boxes ? 6 : 9;
    if (made.points.empty() || made.points.size() % each != 0) {
      return fail(std::to_string(made.points.size() / 3) + " points, and " +
                  (made.is_boxes ? "a box takes 2" : "a triangle takes 3"));
    }
    out_.geometries.push_back(std::move(made));
  }

  void instance() {
    SceneInstance made;
    made.bottom_level = (*words_)[3].text;
    const bool known = std::any_of(
        out_.geometries.begin(), out_.geometries.end(),
        [&](const SceneGeometry& one) { return one.bottom_level == made.bottom_level; });
    if (!known) return fail("there is no geometry '" + made.bottom_level + "' above");
    rtapi::RaytracingInstanceDesc& desc = made.desc;
    for (int i = 0; i < 3; ++i) desc.Transform[i][i] = 1;
    desc.InstanceMask = 0xFF;
    for (size_t i = 4; i < words_->size() && out_.error.empty(); i += 2) {
      const std::string& name = (*words_)[i].text;
      if (i + 1 == words_->size()) return fail("'" + name + "' has no value");
      option(name, (*words_)[i + 1], desc);
    }
    if (out_.error.empty()) out_.instances.push_back(std::move(made));
  }

  void option(const std::string& name, const Word& value, rtapi::RaytracingInstanceDesc& desc) {
    if (name == "at" || name == "transform") {
      const std::vector<float> numbers = floats_of(value.text, name == "at" ? 3 : 12);
      if (!value.is_list || numbers.empty()) {
        return fail("'" + name + "' takes " +
                    (name == "at" ? "(x, y, z)"
                                  : "twelve numbers in "
                                    "brackets, three rows of four"));
      }
      if (name == "transform") {
        std::memcpy(desc.Transform, numbers.data(), sizeof desc.Transform);
      } else {
        for (size_t i = 0; i < 3; ++i) desc.Transform[i][3] = numbers[i];
      }
      return;
    }
    if (name == "scale") {
      const auto scale = float_of(value.text);
      if (!scale) return fail("'scale' takes a number, and here is '" + value.text + "'");
      for (auto& row : desc.Transform) {
        for (int column = 0; column < 3; ++column) row[column] *= *scale;
      }
      return;
    }
    const auto number = number_of(value.text);
    const uint32_t limit = name == "mask" || name == "flags" ? 0xFF : 0xFFFFFF;
    if (!number || *number > limit) {
      return fail("'" + name + "' takes a number from 0 to " + std::to_string(limit) +
                  ", and here is '" + value.text + "'");
    }
    if (name == "id") {
      desc.InstanceID = *number;
    } else if (name == "mask") {
      desc.InstanceMask = *number;
    } else if (name == "hit_group") {
      desc.InstanceContributionToHitGroupIndex = *number;
    } else if (name == "flags") {
      desc.Flags = *number;
    } else {
      fail("'" + name + "' is neither at, scale, transform, id, mask, hit_group nor flags");
    }
  }

  void fail(const std::string& text) {
    if (out_.error.empty()) out_.error = "line " + std::to_string(line_) + ": " + text;
  }

  SceneDescription& out_;
  const std::vector<Word>* words_ = nullptr;
  uint32_t line_ = 0;
};

// The geometries of a bottom level, whose inputs go to `memory`.
std::vector<rtapi::RaytracingGeometryDesc> describe(const rtapi::Device& device,
                                                    const SceneDescription& description,
                                                    const std::string& name, Scene& scene) {
  std::vector<rtapi::RaytracingGeometryDesc> out;
  for (const SceneGeometry& from : description.geometries) {
    if (from.bottom_level != name) continue;
    scene.memory.push_back(rtapi::CreateUploadBuffer(device, from.points, name).value());
    const uint64_t address = scene.memory.back().GetGPUVirtualAddress();
    rtapi::RaytracingGeometryDesc desc;
    desc.Flags = from.flags;
    if (from.is_boxes) {
      desc.Type = rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
      desc.AABBs = {from.points.size() / 6, {address, sizeof(rtapi::RaytracingAabb)}};
    } else {
      desc.Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
      desc.Triangles.VertexCount = static_cast<uint32_t>(from.points.size() / 3);
      desc.Triangles.VertexBuffer = {address, 12};
    }
    out.push_back(desc);
  }
  return out;
}

}  // namespace

SceneDescription read_scene(std::string_view text) {
  SceneDescription out;
  SceneReader reader(out);
  uint32_t number = 0;
  while (!text.empty() && out.error.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::vector<Word> words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    const bool is_ours =
        words.size() > 1 && words[0].text == "#pragma" && words[1].text == "kaamos";
    if (is_ours) reader.read_line(words, number);
  }
  return out;
}

Scene build_scene(const rtapi::Device& device, const rtapi::CommandQueue& queue,
                  const SceneDescription& description) {
  Scene scene;
  std::vector<std::pair<std::string, rtapi::Buffer>> levels;
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (const SceneInstance& instance : description.instances) {
    auto level = std::find_if(levels.begin(), levels.end(),
                              [&](const auto& one) { return one.first == instance.bottom_level; });
    if (level == levels.end()) {
      const auto geometries = describe(device, description, instance.bottom_level, scene);
      levels.emplace_back(instance.bottom_level, test::build_bottom_level(device, queue, geometries,
                                                                          instance.bottom_level));
      level = std::prev(levels.end());
    }
    rtapi::RaytracingInstanceDesc desc = instance.desc;
    desc.AccelerationStructure = level->second.GetGPUVirtualAddress();
    instances.push_back(desc);
  }
  for (auto& [name, buffer] : levels) scene.memory.push_back(buffer);
  scene.top_level = test::build_top_level(device, queue, instances, "test scene");
  return scene;
}

}  // namespace kaamos::shader_tests
