// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/attributes.h"

#include <algorithm>
#include <cctype>

namespace kaamos::hlsl {

bool same_word(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return std::tolower(static_cast<unsigned char>(x)) ==
                  std::tolower(static_cast<unsigned char>(y));
         });
}

const Attribute* find_attribute(const FunctionInfo& function, std::string_view name) {
  for (const FunctionDecl* decl : {function.decl, function.definition}) {
    if (!decl) continue;
    if (const Attribute* found = find_attribute(decl->attributes, name)) return found;
  }
  return nullptr;
}

const Attribute* find_attribute(std::span<const Attribute> attributes, std::string_view name) {
  for (const Attribute& attribute : attributes) {
    if (attribute.scope.empty() && same_word(attribute.name, name)) return &attribute;
  }
  return nullptr;
}

}  // namespace kaamos::hlsl
