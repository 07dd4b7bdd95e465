// SPDX-License-Identifier: MIT
#include "effects/assets/scene/camera_path.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "effects/assets/common/file.h"

namespace kaamos::effects {
namespace {

constexpr double kLargest = 1e9;  // metres, seconds

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> out;
  constexpr std::string_view kSpace = " \t\r";
  line = line.substr(0, line.find('#'));
  for (std::size_t at = line.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
    out.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSpace, end);
  }
  return out;
}

bool parse_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::abs(value) <= kLargest;
}

// Returns what is wrong with the words, or an empty text.
std::string parse_key(const std::vector<std::string_view>& words, CameraKey& key) {
  double numbers[7];
  if (words.size() < std::size(numbers)) {
    return std::to_string(words.size()) +
           " values, 7 expected: seconds, the eye's x y z, the target's x y z";
  }
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    if (!parse_number(words[i], numbers[i])) {
      return "\"" + std::string(words[i]) + "\" is not a number from -1e9 to 1e9";
    }
  }
  key.seconds = numbers[0];
  key.eye = {numbers[1], numbers[2], numbers[3]};
  key.target = {numbers[4], numbers[5], numbers[6]};
  if (key.eye == key.target) return "the eye stands in its target; move one of them";
  for (std::size_t i = std::size(numbers); i < words.size(); ++i) {
    double degrees = 0.0;
    if (words[i] == "cut") {
      key.cut = true;
    } else if (words[i].substr(0, 4) == "fov=" && parse_number(words[i].substr(4), degrees) &&
               degrees > 0.0 && degrees < 180.0) {
      key.vertical_fov = glm::radians(degrees);
    } else {
      return "\"" + std::string(words[i]) +
             "\" is neither \"cut\" nor \"fov=\" and degrees between 0 and 180";
    }
  }
  return {};
}

// A cubic curve through b and c, whose slope at each is that between its neighbours. Where there is
// no neighbour, a equals b and d equals c. [Catmull & Rom 1974, with uneven times]
template <class T>
T curve(const T& a, const T& b, const T& c, const T& d, const double (&t)[4], double at) {
  const double h = t[2] - t[1], u = (at - t[1]) / h;
  const T from = (c - a) * (h / (t[2] - t[0])), to = (d - b) * (h / (t[3] - t[1]));
  const double u2 = u * u, u3 = u2 * u;
  return b * (2 * u3 - 3 * u2 + 1) + c * (3 * u2 - 2 * u3) + from * (u3 - 2 * u2 + u) +
         to * (u3 - u2);
}

}  // namespace

Result<CameraPath> parse_camera_path(std::string_view text, const std::string& name) {
  CameraPath path;
  path.name = name;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++number;
    const auto words = words_of(text.substr(at, end - at));
    at = end + 1;
    if (words.empty()) continue;
    CameraKey key;
    std::string wrong = parse_key(words, key);
    if (wrong.empty() && !path.keys.empty() && !(key.seconds > path.keys.back().seconds)) {
      wrong = "times must rise, and " + std::string(words[0]) + " does not";
    }
    if (!wrong.empty())
      return make_error(ErrorId::kCameraPath, name + ":" + std::to_string(number) + ": " + wrong);
    path.keys.push_back(key);
  }
  if (path.keys.empty()) {
    return make_error(
        ErrorId::kCameraPath,
        name + ": no position; give lines of seconds, the eye's x y z and the target's x y z");
  }
  return path;
}

Result<CameraPath> load_camera_path(const std::string& file) {
  const auto bytes = read_file(file, std::size_t{16} << 20);
  if (!bytes.ok()) return bytes.error();
  const auto& text = bytes.value();
  return parse_camera_path({reinterpret_cast<const char*>(text.data()), text.size()}, file);
}

Camera evaluate_camera(const CameraPath& path, const Camera& scene_camera, double seconds) {
  const std::vector<CameraKey>& keys = path.keys;
  Camera camera = scene_camera;
  if (path.name == "still") return camera;
  const auto later = std::upper_bound(keys.begin(), keys.end(), seconds,
                                      [](double at, const CameraKey& k) { return at < k.seconds; });
  const auto fov = [&](const CameraKey& k) {
    return k.vertical_fov > 0.0 ? k.vertical_fov : scene_camera.vertical_fov;
  };
  if (later == keys.begin() || later == keys.end() || later->cut) {
    const CameraKey& key = later == keys.begin() ? keys.front() : *(later - 1);
    camera.camera_to_world = look_at(key.eye, key.target);
    camera.vertical_fov = fov(key);
    return camera;
  }
  const auto b = later - 1, c = later;
  const auto a = b == keys.begin() || b->cut ? b : b - 1;
  const auto d = c + 1 == keys.end() || (c + 1)->cut ? c : c + 1;
  const double times[4] = {a->seconds, b->seconds, c->seconds, d->seconds};
  const auto at = [&](const auto& of) {
    return curve(of(*a), of(*b), of(*c), of(*d), times, seconds);
  };
  const glm::dvec3 eye = at([](const CameraKey& k) { return k.eye; });
  const glm::dvec3 target = at([](const CameraKey& k) { return k.target; });
  camera.vertical_fov = std::clamp(at(fov), 1e-3, glm::pi<double>() - 1e-3);
  // The two curves may cross where their keys do not.
  if (eye != target) camera.camera_to_world = look_at(eye, target);
  return camera;
}

bool has_cut(const CameraPath& path, double before, double now) {
  return std::any_of(path.keys.begin(), path.keys.end(), [&](const CameraKey& key) {
    return key.cut && key.seconds > before && key.seconds <= now;
  });
}

}  // namespace kaamos::effects
