// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "tests/shaders/gltf_geometry.h"
#include "tests/shaders/scene.h"

namespace kaamos::shader_tests {
namespace {

// The words of a line; "(1, 2, 3)" is one word without its brackets, and so are quoted words.
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
    if (line[i] == '"') {
      const size_t end = std::min(line.find('"', i + 1), line.size());
      out.push_back({std::string(line.substr(i + 1, end - i - 1)), false});
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

// The values of "1, 2, 3"; nothing if one of them is none.
template <class Value>
std::vector<Value> values_of(const std::string& list,
                             std::optional<Value> (*value_of)(const std::string&)) {
  std::vector<Value> out;
  size_t at = 0;
  while (at <= list.size()) {
    const size_t comma = std::min(list.find(',', at), list.size());
    const auto value = value_of(list.substr(at, comma - at));
    if (!value) return {};
    out.push_back(*value);
    at = comma + 1;
  }
  return out;
}

// "1, 2, 3"; empty unless there are `count`.
std::vector<float> floats_of(const std::string& list, size_t count) {
  std::vector<float> out = values_of(list, float_of);
  return out.size() == count ? out : std::vector<float>();
}

// A 32-bit constant: "0.5" and "1e3" are floats, "-1" and "0x10" integers.
std::optional<uint32_t> constant_of(const std::string& text) {
  const bool is_hex = text.find_first_of("xX") != std::string::npos;
  if (!is_hex && text.find_first_of(".eE") != std::string::npos) {
    const auto value = float_of(text);
    return value ? std::optional(std::bit_cast<uint32_t>(*value)) : std::nullopt;
  }
  char* end = nullptr;
  const long long value = std::strtoll(text.c_str(), &end, 0);
  while (std::isspace(static_cast<unsigned char>(*end)) != 0) ++end;
  const bool fits = value >= INT32_MIN && value <= int64_t{UINT32_MAX};
  if (end == text.c_str() || *end != 0 || !fits) return std::nullopt;
  return static_cast<uint32_t>(value);
}

class SceneReader {
 public:
  SceneReader(SceneDescription& out, std::string folder) : out_(out), folder_(std::move(folder)) {}

  void read_line(const std::vector<Word>& words, uint32_t line) {
    words_ = &words;
    line_ = line;
    const std::string what = words.size() > 2 ? words[2].text : "";
    const std::pair<std::string_view, void (SceneReader::*)()> kLines[] = {
        {"geometry", &SceneReader::geometry},
        {"gltf", &SceneReader::gltf},
        {"instance", &SceneReader::instance},
        {"record", &SceneReader::record}};
    for (const auto& [name, read] : kLines) {
      if (words.size() >= 4 && what == name) return (this->*read)();
    }
    fail("'#pragma kaamos " + what +
         "' is none; write '#pragma kaamos geometry NAME ...', or gltf, instance or record in "
         "place of geometry");
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

  void gltf() {
    if (words_->size() != 5) return fail("'gltf' takes a name and a file, in quotes");
    std::string path = (*words_)[4].text;
    if (!path.starts_with('/') && !folder_.empty()) path = folder_ + "/" + path;
    const std::string error = read_gltf(path, (*words_)[3].text, out_.geometries);
    if (!error.empty()) return fail(error);
    out_.files.push_back(std::move(path));
  }

  void record() {
    SceneRecord made;
    made.export_name = (*words_)[3].text;
    for (size_t i = 4; i < words_->size(); ++i) {
      const Word& word = (*words_)[i];
      auto constants = word.is_list ? values_of(word.text, constant_of) : std::vector<uint32_t>();
      if (constants.empty()) {
        return fail("'" + word.text +
                    "' is no list of constants; write (0.5, 3) for each parameter of the local "
                    "root signature");
      }
      made.constants.push_back(std::move(constants));
    }
    out_.records.push_back(std::move(made));
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
  std::string folder_;
  const std::vector<Word>* words_ = nullptr;
  uint32_t line_ = 0;
};

}  // namespace

SceneDescription read_scene(std::string_view text, const std::string& folder) {
  SceneDescription out;
  SceneReader reader(out, folder);
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

}  // namespace kaamos::shader_tests
