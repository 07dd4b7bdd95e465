// SPDX-License-Identifier: MIT
//
// Takes from a collection what a pipeline needs: copies of its exports, with everything that the
// collection resolved. [DXR: Collection state object]
#include "rtapi/src/pipelines/state_object_gatherer.h"

namespace rtapi::detail {

Status Gatherer::gather(const ExistingCollectionDesc& sub, size_t i) {
  const std::string where = where_of(i);
  if (parts_.is_collection()) {
    return make_error(Id::kCollectionNested, where,
                      " is an existing collection; only a pipeline may include collections");
  }
  if (!sub.pExistingCollection) {
    return make_error(Id::kNullHandle, where, ": pExistingCollection is empty");
  }
  if (Status s = CheckHandle(parts_.device, *sub.pExistingCollection, where); !s.ok()) return s;
  const StateObjectImpl& collection = *sub.pExistingCollection->impl();
  if (collection.type != StateObjectType::kCollection) {
    return make_error(Id::kCollectionNested, where,
                      " is a pipeline; only collections can be "
                      "included. Use AddToStateObject to extend a pipeline");
  }
  const auto additions = StateObjectFlags::kAllowStateObjectAdditions;
  if (HasAny(parts_.flags, additions) && !HasAny(collection.flags, additions)) {
    return make_error(Id::kCollectionWithoutAdditions, where,
                      ": the pipeline has flag 0x4 "
                      "(kAllowStateObjectAdditions), so the collection needs it too");
  }
  return import_collection(collection, sub.Exports, where);
}

Status Gatherer::import_collection(const StateObjectImpl& collection,
                                   const std::vector<ExportDesc>& exports,
                                   const std::string& where) {
  const int scope = parts_.collection_count++;
  const bool referable =
      HasAny(collection.flags, StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions);
  std::map<const Subject*, SubjectPtr> copies;
  for (const SubjectPtr& original : collection.subjects) {
    auto copy = std::make_shared<Subject>(*original);
    copy->collection_scope = scope;
    copy->library_scope = -1;
    copy->referable = referable;
    copy->hidden = original->hidden || !exports.empty();
    copies[original.get()] = copy;
    parts_.subjects.push_back(copy);
  }
  for (auto& [original, copy] : copies) {
    for (SubjectPtr& member : copy->members) {
      if (member) member = copies[member.get()];
    }
  }
  if (Status s = list_collection_exports(collection, copies, exports, where); !s.ok()) return s;
  if (!referable) return {};
  for (const ExplicitAssociation& a : collection.outward_associations) {
    parts_.explicit_associations.push_back(a);
    parts_.explicit_associations.back().library_scope = -1;
  }
  return {};
}

Status Gatherer::list_collection_exports(const StateObjectImpl& collection,
                                         std::map<const Subject*, SubjectPtr>& copies,
                                         const std::vector<ExportDesc>& exports,
                                         const std::string& where) {
  for (const ExportDesc& wanted : exports) {
    const std::string& source = wanted.ExportToRename.empty() ? wanted.Name : wanted.ExportToRename;
    bool found = false;
    for (const SubjectPtr& original : collection.subjects) {
      if (original->hidden || !original->answers_to(source)) continue;
      found = true;
      SubjectPtr& copy = copies[original.get()];
      if (copy->hidden) {
        copy->hidden = false;
        if (wanted.Name != source) {
          copy->name = wanted.Name;
          copy->mangled.clear();
        }
      } else {  // the same export under a second name
        auto again = std::make_shared<Subject>(*copy);
        again->name = wanted.Name;
        again->mangled.clear();
        parts_.subjects.push_back(std::move(again));
      }
    }
    if (!found) {
      return make_error(Id::kExportNotFound, where, ": the collection has no export ",
                        in_quotes(source));
    }
  }
  return {};
}
}  // namespace rtapi::detail
