// SPDX-License-Identifier: MIT
//
// Second stage of making a state object: decides which configs and root signatures belong to which
// export. [DXR: Subobject association behavior]
#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "rtapi/src/pipelines/state_object_impl.h"

namespace rtapi::detail {

namespace {

// Indexes explicit associations by the export names they list, because a large pipeline has
// thousands of exports.
using Index = std::unordered_map<std::string_view, std::vector<const ExplicitAssociation*>>;

Index make_index(const Parts& parts) {
  Index index;
  for (const ExplicitAssociation& a : parts.explicit_associations) {
    for (const std::string& name : a.exports) index[name].push_back(&a);
  }
  return index;
}

std::vector<const ExplicitAssociation*> find(const Index& index, const Subject& subject) {
  std::vector<const ExplicitAssociation*> found;
  for (const std::string* name : {&subject.name, &subject.mangled}) {
    auto it = index.find(*name);
    if (name->empty() || it == index.end()) continue;
    found.insert(found.end(), it->second.begin(), it->second.end());
  }
  return found;
}

// Finds the explicit association of a subject in one category, on one level: in the state object
// itself, or in any of its libraries. Several associations are fine as long as they agree.
Result<DefinitionPtr> find_explicit(const std::vector<const ExplicitAssociation*>& candidates,
                                    const Subject& subject, Category category,
                                    bool in_state_object) {
  const ExplicitAssociation* first = nullptr;
  for (const ExplicitAssociation* a : candidates) {
    if (a->definition->category != category || (a->library_scope < 0) != in_state_object) continue;
    if (first && !same_definition(*first->definition, *a->definition)) {
      return make_error(Id::kAssociationConflict, in_quotes(subject.name),
                        " is associated with two ", category_name(category),
                        "s: ", first->definition->where, " (by ", first->where, ") and ",
                        a->definition->where, " (by ", a->where, ")");
    }
    if (!first) first = a;
  }
  return first ? first->definition : nullptr;
}

// Returns the default of a scope, or null. An association with an empty export list takes
// precedence over subobjects that are in no association. If several different candidates remain,
// there is no default.
DefinitionPtr find_default(const DefaultScope& scope, Category category) {
  for (const auto* candidates : {&scope.by_empty, &scope.implicit}) {
    DefinitionPtr found;
    bool ambiguous = false;
    for (const DefinitionPtr& d : *candidates) {
      if (d->category != category) continue;
      if (found && !same_definition(*found, *d)) ambiguous = true;
      found = d;
    }
    if (ambiguous) return nullptr;
    if (found) return found;
  }
  return nullptr;
}

Result<Associated> resolve(const Parts& parts,
                           const std::vector<const ExplicitAssociation*>& candidates,
                           const Subject& subject, Category category) {
  const auto own = find_explicit(candidates, subject, category, true);
  if (!own.ok()) return own.error();
  const Associated& given = subject.associations[static_cast<size_t>(category)];
  if (given.definition) {  // set by its collection, so final
    if (*own && !same_definition(**own, *given.definition)) {
      return make_error(Id::kAssociationConflict, "the collection of ", in_quotes(subject.name),
                        " already set its ", category_name(category), " (", given.definition->where,
                        "), so ", (*own)->where,
                        " cannot replace it; associate it when you create the collection");
    }
    return given;
  }
  if (*own) return Associated{*own, Strength::kExplicit};
  if (auto d = find_default(parts.own_scope, category)) return Associated{d, Strength::kDefault};
  const auto in_libraries = find_explicit(candidates, subject, category, false);
  if (!in_libraries.ok()) return in_libraries.error();
  if (*in_libraries) return Associated{*in_libraries, Strength::kExplicit};
  if (subject.library_scope >= 0) {
    const auto& scope = parts.library_scopes[static_cast<size_t>(subject.library_scope)];
    if (auto d = find_default(scope, category)) return Associated{d, Strength::kDefault};
  }
  return Associated{};
}

// Every name in an explicit association of a pipeline must exist. Libraries may name their own
// functions even if an export list left them out.
Status check_names_exist(const Parts& parts) {
  for (const ExplicitAssociation& a : parts.explicit_associations) {
    for (const std::string& name : a.exports) {
      const bool known = std::any_of(parts.subjects.begin(), parts.subjects.end(),
                                     [&](const SubjectPtr& s) { return s->answers_to(name); });
      if (known) continue;
      if (a.library_scope >= 0) {
        const auto& library = parts.libraries[static_cast<size_t>(a.library_scope)];
        const auto& exports = library.GetExports();
        if (std::any_of(exports.begin(), exports.end(), [&](const ShaderExportInfo& e) {
              return e.Name == name || e.MangledName == name;
            })) {
          continue;
        }
      }
      return make_error(Id::kAssociationUnknownExport, a.where, " associates ",
                        category_name(a.definition->category), " with ", in_quotes(name),
                        ", which this state object does not export");
    }
  }
  return {};
}

}  // namespace

Status associate_all(Parts& parts) {
  if (!parts.is_collection()) {
    if (Status s = check_names_exist(parts); !s.ok()) return s;
  }
  const Index index = make_index(parts);
  for (const SubjectPtr& subject : parts.subjects) {
    const auto candidates = find(index, *subject);
    for (size_t c = 0; c < kCategories; ++c) {
      auto associated = resolve(parts, candidates, *subject, static_cast<Category>(c));
      if (!associated.ok()) return associated.error();
      subject->associations[c] = *associated;
    }
  }
  return {};
}

}  // namespace rtapi::detail
