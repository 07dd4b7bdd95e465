// SPDX-License-Identifier: MIT
//
// Functions that a library declares and another one of the state object defines. Shaders that call
// them are compiled together with the libraries that define them, and replace those of the library.
// [DXR: D3D12_STATE_OBJECT_FLAGS; D3D12: library linkage]
#include <algorithm>
#include <deque>
#include <map>

#include "rtapi/src/pipelines/state_object_impl.h"
#include "rtapi/src/shaders/linked_library.h"
#include "rtapi/src/shaders/shader_library_impl.h"

namespace rtapi::detail {
namespace {

using shader::Stage;

const shader::LibraryDesc& desc_of(const Subject& s) {
  return *s.library.impl()->desc;
}

class FunctionLinker {
 public:
  explicit FunctionLinker(Parts& parts) : parts_(parts) {}

  Status run() {
    // A library's shaders that one scope sees alike are compiled together.
    std::map<std::pair<const shader::LibraryDesc*, int>, std::vector<SubjectPtr>> groups;
    std::vector<std::pair<const shader::LibraryDesc*, int>> order;
    for (const SubjectPtr& s : parts_.subjects) {
      if (s->is_group() || s->code->import_count == 0) continue;
      Plan ignored;
      if (Status status = visit(*s, ignored); !status.ok()) {
        const bool may_wait = parts_.may_stay_unresolved() || s->hidden;
        if (status.error().id == public_id(Id::kFunctionUnresolved) && may_wait) continue;
        return status;
      }
      if (s->code->stage == Stage::kLibrary) continue;
      const auto key = std::make_pair(&desc_of(*s), s->collection_scope);
      if (groups[key].empty()) order.push_back(key);
      groups[key].push_back(s);
    }
    for (const auto& key : order) {
      if (Status status = link(groups[key]); !status.ok()) return status;
    }
    return {};
  }

 private:
  struct Plan {
    LinkPlan link;
    std::map<std::pair<const shader::LibraryDesc*, int>, uint32_t> places;
    std::map<std::pair<uint32_t, uint32_t>, bool> known;  // imports by library
    std::vector<SubjectPtr> definitions;
  };

  static uint32_t place_of(const Subject& s, Plan& plan) {
    const auto [it, is_new] = plan.places.emplace(std::pair(&desc_of(s), s.collection_scope),
                                                  static_cast<uint32_t>(plan.places.size()));
    if (is_new) plan.link.libraries.push_back(s.library);
    return it->second;
  }

  // Adds what the subject reaches, through any number of libraries.
  Status visit(const Subject& first, Plan& plan) {
    std::deque<const Subject*> waiting = {&first};
    while (!waiting.empty()) {
      const Subject& s = *waiting.front();
      waiting.pop_front();
      const uint32_t place = place_of(s, plan);
      for (uint32_t i = 0; i < s.code->import_count; ++i) {
        const uint32_t import = s.code->imports[i];
        if (!plan.known.emplace(std::pair(place, import), true).second) continue;
        auto found = find_definition(s, desc_of(s).imports[import]);
        if (!found.ok()) return found.error();
        const Subject& definition = **found;
        plan.link.imports.push_back(
            {place, import, place_of(definition, plan),
             static_cast<uint32_t>(definition.code - desc_of(definition).exports)});
        plan.definitions.push_back(*found);
        waiting.push_back(&definition);
      }
    }
    return {};
  }

  static std::string caller_text(const Subject& s) {
    return concat(s.code->stage == Stage::kLibrary ? "function " : "shader ", in_quotes(s.name),
                  " of ", in_quotes(s.library.name()));
  }

  Result<SubjectPtr> find_definition(const Subject& user, const shader::ImportDesc& import) const {
    SubjectPtr found, other;
    for (const SubjectPtr& s : parts_.subjects) {
      const bool is_visible = !s->hidden || s->collection_scope == user.collection_scope;
      if (s->is_group() || !is_visible) continue;
      // A renamed export has no mangled name in the state object; its new one may be either.
      const bool is_renamed =
          s->mangled.empty() && s->name == import.name && same_parameters(*s->code, import);
      const bool is_meant =
          s->code->stage == Stage::kLibrary && (s->answers_to(import.mangled_name) || is_renamed);
      if (is_meant && (!found || s->collection_scope == user.collection_scope)) found = s;
      if (!is_meant && s->name == import.name) other = s;
    }
    if (!found && other) {
      return make_error(
          Id::kFunctionDiffers, caller_text(user), " calls ", in_quotes(import.signature), ", but ",
          in_quotes(other->library.name()), " exports ",
          other->code->signature ? concat("function ", in_quotes(other->code->signature))
                                 : concat("shader ", in_quotes(other->name)),
          " under that name; declare it with the types of its definition");
    }
    if (!found) {
      return make_error(Id::kFunctionUnresolved, caller_text(user), " calls ",
                        in_quotes(import.signature),
                        ", which has no body there, and no library of this ",
                        parts_.is_collection() ? "collection" : "state object", " exports it");
    }
    if (!found->referable && found->collection_scope != user.collection_scope) {
      return make_error(Id::kFunctionNotReferable, caller_text(user), " calls ",
                        in_quotes(import.signature),
                        " of a collection that lacks flag 0x2 "
                        "(kAllowExternalDependenciesOnLocalDefinitions)");
    }
    return found;
  }

  // Compares what mangled names say behind the function's own name.
  static bool same_parameters(const shader::ExportDesc& code, const shader::ImportDesc& import) {
    const auto behind = [](std::string_view mangled) {
      const size_t end = mangled.find("@@");
      return end == std::string_view::npos ? mangled : mangled.substr(end);
    };
    return code.mangled_name && behind(code.mangled_name) == behind(import.mangled_name);
  }

  Status link(const std::vector<SubjectPtr>& subjects) {
    Plan plan;
    for (const SubjectPtr& s : subjects) {
      if (Status status = visit(*s, plan); !status.ok()) return status;
      const auto entry = static_cast<uint32_t>(s->code - desc_of(*s).exports);
      auto& entries = plan.link.entries;
      if (std::find(entries.begin(), entries.end(), entry) == entries.end()) {
        entries.push_back(entry);
      }
    }
    const std::string where = caller_text(*subjects[0]);
    for (const ShaderLibrary& library : plan.link.libraries) {
      if (library.impl()->desc->source) continue;
      return make_error(Id::kFunctionNoSource, where, " is linked with ", in_quotes(library.name()),
                        ", which carries no source; compile that without -no-source");
    }
    const ModuleLibrary linked = linked_library(plan.link, parts_.device->desc.Backend == "vulkan");
    if (!linked.library) {
      return make_error(Id::kFunctionLink, where, " cannot be linked:\n", linked.error);
    }
    if (const std::string text = parts_.device->say_interpreted(where, linked.slow);
        !text.empty()) {
      parts_.device->report(MessageSeverity::kWarning, make_error(Id::kFunctionInterpreted, text));
    }
    const shader::LibraryDesc& table = *linked.library.impl()->desc;
    for (const SubjectPtr& s : subjects) {
      const auto* end = table.exports + table.export_count;
      const auto* code = std::find_if(table.exports, end, [&](const shader::ExportDesc& e) {
        return std::string_view(e.name) == s->code->name && e.stage == s->code->stage;
      });
      if (code == end) {
        return make_error(Id::kFunctionLink, where, " cannot be linked: ", in_quotes(s->code->name),
                          " is not in its source");
      }
      s->written = s->code;
      s->written_library = s->library;
      s->code = code;
      s->library = linked.library;
      s->linked_functions = plan.definitions;
    }
    return {};
  }

  Parts& parts_;
};

}  // namespace

Status link_functions(Parts& parts) {
  return FunctionLinker(parts).run();
}

}  // namespace rtapi::detail
