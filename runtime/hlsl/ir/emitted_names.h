// SPDX-License-Identifier: MIT
//
// C++ names for HLSL names. They stay the same wherever C++ allows it, because a debugger shows
// them.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace kaamos::hlsl {

// Turns a qualified HLSL name into a C++ identifier: "Scene::Vertex<float>" gives
// "Scene_Vertex_float_". Words that already have a meaning in C++ or in the emitted code get a
// trailing "_".
std::string cpp_identifier(std::string_view name);

// Hands out names that are unique within one set.
class NameSet {
 public:
  std::string add(std::string_view hlsl_name);

 private:
  std::unordered_set<std::string> used_;
};

// Names the variables of one function. A name can be reused in a sibling scope, but a nested scope
// adds a number, so that hoisted declarations never hide each other.
class ScopedNames {
 public:
  void push() { scopes_.emplace_back(); }
  void pop() { scopes_.pop_back(); }
  std::string declare(std::string_view hlsl_name);

 private:
  bool visible(const std::string& name) const;

  std::vector<std::unordered_set<std::string>> scopes_;
};

}  // namespace kaamos::hlsl
