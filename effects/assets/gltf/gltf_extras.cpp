// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_extras.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace kaamos::effects {
namespace {

using tinygltf::Value;

constexpr const char* kKey = "kaamos";

// As a double with the float's value, which JSON's shortest form brings back bit for bit.
Value number(float value) {
  return Value(static_cast<double>(value));
}

Value triple(const glm::vec3& v) {
  return Value(Value::Array{number(v.x), number(v.y), number(v.z)});
}

Value under_key(Value::Object members) {
  return Value(Value::Object{{kKey, Value(std::move(members))}});
}

/// Models of a material's own, in `model` of its extras.
struct ModelName {
  const char* name;
  std::uint32_t flag;
};
constexpr ModelName kModels[] = {
    {"skin", kMaterialSkin}, {"eye", kMaterialEye}, {"hair", kMaterialHair}};

/// One object below the key, and the warnings about its values.
class Reader {
 public:
  Reader(const Value& extras, const std::string& where, std::vector<std::string>& warnings)
      : where_(where), warnings_(warnings) {
    if (extras.IsObject() && extras.Has(kKey) && extras.Get(kKey).IsObject())
      object_ = &extras.Get(kKey);
  }

  /// Goes to a member that is an object; false where there is none.
  bool enter(const char* key) {
    if (!has(key) || !object_->Get(key).IsObject()) return false;
    object_ = &object_->Get(key);
    return true;
  }
  bool has(const char* key) const { return object_ != nullptr && object_->Has(key); }

  /// A member from 0 to `limit`; `fallback`, with a warning, where it is none.
  double number(const char* key, double limit, double fallback) {
    if (!has(key)) return fallback;
    const Value& value = object_->Get(key);
    if (usable(value, limit)) return value.GetNumberAsDouble();
    warn(key, "a number from 0 to " + limit_text(limit));
    return fallback;
  }
  /// A member that is true or false; `fallback`, with a warning, where it is neither.
  bool flag(const char* key, bool fallback) {
    if (!has(key)) return fallback;
    if (object_->Get(key).IsBool()) return object_->Get(key).Get<bool>();
    warn(key, "true or false");
    return fallback;
  }
  /// A member that is whole and from 0 to `limit`; empty, with a warning, where it is none.
  std::optional<int> whole(const char* key, double limit) {
    if (!has(key)) return {};
    const double value = number(key, limit, -1.0);
    if (value >= 0.0 && value == std::floor(value)) return static_cast<int>(value);
    if (value >= 0.0)
      warnings_.push_back(where_ + ", extras: " + key + " is not whole; it is left out");
    return {};
  }
  /// The flag of a member that names a model; 0, with a warning, where it names none.
  std::uint32_t model(const char* key) {
    if (!has(key)) return 0;
    const Value& value = object_->Get(key);
    for (const ModelName& each : kModels) {
      if (value.IsString() && value.Get<std::string>() == each.name) return each.flag;
    }
    warn(key, "\"skin\", \"eye\" or \"hair\"");
    return 0;
  }
  /// Three numbers from 0: a colour, radiance or irradiance; black, with a warning, where it is
  /// none.
  glm::vec3 triple(const char* key) { return numbers(key, 0.0, glm::vec3(0.0f)); }
  /// Three numbers of either sign; `fallback`, with a warning, where it is none.
  glm::vec3 vector(const char* key, const glm::vec3& fallback) {
    return numbers(key, -kLargest, fallback);
  }

  static constexpr double kLargest = std::numeric_limits<float>::max();

 private:
  static bool usable(const Value& value, double limit, double least = 0.0) {
    return value.IsNumber() && value.GetNumberAsDouble() >= least &&
           value.GetNumberAsDouble() <= limit;
  }
  glm::vec3 numbers(const char* key, double least, const glm::vec3& fallback) {
    if (!has(key)) return fallback;
    const Value& value = object_->Get(key);
    glm::vec3 out(0.0f);
    bool good = value.IsArray() && value.ArrayLen() == 3;
    for (int c = 0; good && c < 3; ++c) {
      good = usable(value.Get(c), kLargest, least);
      if (good) out[c] = static_cast<float>(value.Get(c).GetNumberAsDouble());
    }
    if (good) return out;
    warn(key, "three numbers from " + limit_text(least) + " to " + limit_text(kLargest));
    return fallback;
  }
  static std::string limit_text(double limit) {
    std::ostringstream text;
    text << limit;
    return text.str();
  }
  void warn(const char* key, const std::string& allowed) {
    warnings_.push_back(where_ + ", extras: " + key + " is not " + allowed + "; it is left out");
  }

  const Value* object_ = nullptr;
  const std::string& where_;
  std::vector<std::string>& warnings_;
};

}  // namespace

Value scene_extras(const Scene& scene) {
  Value::Object sky{{"zenith", triple(scene.sky.zenith)},
                    {"horizon", triple(scene.sky.horizon)},
                    {"ground", triple(scene.sky.ground)}};
  return under_key({{"exposure", number(scene.exposure)}, {"sky", Value(std::move(sky))}});
}

Value sun_extras(const Sun& sun) {
  Value::Object members{{"irradiance", triple(sun.irradiance)},
                        {"angularRadius", number(sun.angular_radius)}};
  return under_key({{"sun", Value(std::move(members))}});
}

Value lamp_extras(const Light& light, int texture) {
  Value::Object members{{"radius", number(light.radius)}};
  if (!light.baked) members["baked"] = Value(false);
  if (light.projection) {
    members["projection"] =
        Value(Value::Object{{"texture", Value(texture)}, {"up", triple(light.projection->up)}});
  }
  return under_key({{"lamp", Value(std::move(members))}});
}

void add_instance_extras(Value& extras, const Instance& instance) {
  Value::Object all;
  if (extras.IsObject()) all = extras.Get<Value::Object>();
  all[kKey] = Value(Value::Object{{"mask", Value(static_cast<int>(instance.mask))}});
  extras = Value(std::move(all));
}

Value material_extras(const MaterialConstants& material) {
  for (const ModelName& each : kModels) {
    if ((material.flags & each.flag) == 0) continue;
    return under_key({{"model", Value(std::string(each.name))}});
  }
  return {};
}

std::optional<SceneExtras> read_scene_extras(const Value& extras, const std::string& where,
                                             std::vector<std::string>& warnings) {
  Reader reader(extras, where, warnings);
  if (!reader.has("sky") && !reader.has("exposure")) return {};
  SceneExtras out;
  out.exposure = static_cast<float>(reader.number("exposure", Reader::kLargest, 1.0));
  if (reader.enter("sky")) {
    out.sky = {.zenith = reader.triple("zenith"),
               .horizon = reader.triple("horizon"),
               .ground = reader.triple("ground")};
  }
  return out;
}

std::optional<SunExtras> read_sun_extras(const Value& extras, const std::string& where,
                                         std::vector<std::string>& warnings) {
  Reader reader(extras, where, warnings);
  if (!reader.enter("sun")) return {};
  constexpr double kQuarterTurn = 1.5707963;
  SunExtras out;
  if (reader.has("irradiance")) out.irradiance = reader.triple("irradiance");
  out.angular_radius =
      static_cast<float>(reader.number("angularRadius", kQuarterTurn, kSunAngularRadius));
  return out;
}

void read_lamp_extras(const Value& extras, const std::string& where, Light& light,
                      std::vector<std::string>& warnings) {
  Reader reader(extras, where, warnings);
  if (!reader.enter("lamp")) return;
  light.radius = static_cast<float>(reader.number("radius", Reader::kLargest, light.radius));
  light.baked = reader.flag("baked", light.baked);
}

std::optional<ProjectionExtras> read_projection_extras(const Value& extras,
                                                       const std::string& where,
                                                       std::vector<std::string>& warnings) {
  Reader reader(extras, where, warnings);
  if (!reader.enter("lamp") || !reader.enter("projection")) return {};
  const std::optional<int> texture =
      reader.whole("texture", std::numeric_limits<std::int32_t>::max());
  if (!texture) return {};
  return ProjectionExtras{*texture, reader.vector("up", ProjectionExtras{}.up)};
}

std::optional<std::uint8_t> read_instance_mask(const Value& extras, const std::string& where,
                                               std::vector<std::string>& warnings) {
  Reader reader(extras, where, warnings);
  const std::optional<int> mask = reader.whole("mask", 255.0);
  if (!mask) return {};
  return static_cast<std::uint8_t>(*mask);
}

std::uint32_t read_material_model(const Value& extras, const std::string& where,
                                  std::vector<std::string>& warnings) {
  return Reader(extras, where, warnings).model("model");
}

}  // namespace kaamos::effects
