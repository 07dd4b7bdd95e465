// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/finish/registers.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace kaamos::hlsl {
namespace {

uint64_t end_of(const BindingFacts& binding) {
  return binding.count == kUnboundedCount ? uint64_t{1} << 32
                                          : binding.register_index + binding.count;
}

// First fit among the registers of the binding's class and space, in the order of declaration;
// unbounded arrays come after all others. Registers of what nothing reads are free, unless the
// source was written for a model before 5.1. [DXC: resource allocation,
// -flegacy-resource-reservation]
void assign_automatic(const ModuleFacts& facts, BindingFacts* binding, FinishReport& report) {
  if (!binding->has_space) binding->space = binding->automatic_space;
  std::vector<const BindingFacts*> taken;
  for (const BindingFacts* other : facts.bindings) {
    const bool same = (other->reachable || facts.reserve_unused) && other->has_register &&
                      other->unit == binding->unit &&
                      other->register_class == binding->register_class &&
                      other->space == binding->space;
    if (same) taken.push_back(other);
  }
  std::sort(taken.begin(), taken.end(), [](const BindingFacts* a, const BindingFacts* b) {
    return a->register_index < b->register_index;
  });
  uint64_t next = 0;
  for (const BindingFacts* other : taken) {
    const bool fits =
        binding->count != kUnboundedCount && next + binding->count <= other->register_index;
    if (fits) break;
    next = std::max(next, end_of(*other));
  }
  if (next + (binding->count == kUnboundedCount ? 1 : binding->count) > (uint64_t{1} << 32)) {
    report.no_register(*binding);
    return;
  }
  binding->register_index = static_cast<uint32_t>(next);
  binding->has_register = true;
}

}  // namespace

void assign_registers(ir::Module& module, ModuleFacts& facts, FinishReport& report) {
  std::set<const BindingFacts*> automatic;
  // DXC places $Globals before any other constant buffer.
  for (BindingFacts* buffer : facts.globals_buffers) {
    if (!buffer->reachable || buffer->has_register) continue;
    assign_automatic(facts, buffer, report);
    automatic.insert(buffer);
  }
  for (const bool unbounded : {false, true}) {
    for (BindingFacts* binding : facts.bindings) {
      if (!binding->reachable || binding->has_register) continue;
      if ((binding->count == kUnboundedCount) != unbounded) continue;
      assign_automatic(facts, binding, report);
      automatic.insert(binding);
    }
  }
  for (BindingFacts* binding : facts.bindings) {
    if (!binding->reachable) continue;
    binding->index = static_cast<uint32_t>(module.bindings.size());
    for (ir::Expr* use : binding->uses) use->index = binding->index;
    ir::Binding& entry = module.bindings.emplace_back();
    entry.name = binding->name;
    entry.type = binding->resource;
    entry.register_class = binding->register_class;
    entry.register_index = binding->register_index;
    entry.space = binding->space;
    entry.count = static_cast<uint32_t>(binding->count);
    entry.is_array = binding->is_array;
    entry.automatic = binding->is_automatic || automatic.count(binding) != 0;
    entry.size_bytes = binding->size_bytes;
    entry.location = report.locate(binding->place);
  }
}

void check_overlaps(const ir::Module& module, const ModuleFacts& facts, FinishReport& report) {
  std::vector<const BindingFacts*> by_index(module.bindings.size());
  for (const BindingFacts* binding : facts.bindings) {
    if (binding->reachable) by_index[binding->index] = binding;
  }
  std::set<std::pair<uint32_t, uint32_t>> reported;
  for (const ir::EntryPoint& entry : module.entry_points) {
    for (size_t i = 0; i < entry.bindings.size(); ++i) {
      for (size_t j = i + 1; j < entry.bindings.size(); ++j) {
        const BindingFacts& a = *by_index[entry.bindings[i]];
        const BindingFacts& b = *by_index[entry.bindings[j]];
        // Bindings that two libraries declare may be the same resource.
        const bool overlap = a.unit == b.unit && a.register_class == b.register_class &&
                             a.space == b.space && a.register_index < end_of(b) &&
                             b.register_index < end_of(a);
        if (!overlap || !reported.insert({a.index, b.index}).second) continue;
        report.overlap(a, b,
                       std::string(1, kClassLetters[b.register_class]) +
                           std::to_string(std::max(a.register_index, b.register_index)),
                       entry);
      }
    }
  }
}

}  // namespace kaamos::hlsl
