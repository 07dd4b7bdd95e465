// SPDX-License-Identifier: MIT
//
// The stages: sets up an invocation's context, its static globals and its entry point's parameters.
#include <alloca.h>
#include <kaamos/shader/checked.h>
#include <kaamos/shader/prelude.h>

#include <cstring>

#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using ir::EntryParameter;

namespace {

// Sources of an entry point's parameters; null if the stage has none.
struct Arguments {
  void* payload = nullptr;
  const void* attributes = nullptr;
  const uint32_t* thread = nullptr;
  const uint32_t* size = nullptr;
  const shader::Column* inputs = nullptr;
  shader::Column* outputs = nullptr;
  const shader::GeometryInputs* geometry = nullptr;
  uint32_t lane = 0;
  bool is_live = false;
};

void put_numbers(std::byte* to, const ir::Type* type, const uint32_t (&numbers)[3]) {
  with_scalar(type->scalar, [&](auto scalar) {
    using T = typename decltype(scalar)::type;
    const uint32_t count = component_count(type);
    for (uint32_t i = 0; i < count && i < 3; ++i) {
      const T value = shader::op::Convert<T>::apply(numbers[i]);
      std::memcpy(to + i * sizeof(T), &value, sizeof(T));
    }
  });
}

void put_compute_value(EntryParameter parameter, std::byte* to, const ir::Type* type,
                       const shader::ComputeGroup& group, const Arguments& arguments) {
  const uint32_t* thread = arguments.thread;
  const uint32_t* size = arguments.size;
  switch (parameter) {
    case EntryParameter::kDispatchThreadId: {
      const shader::uint3 id = shader::dispatch_thread_id<shader::uint3>(group, size, thread);
      return put_numbers(to, type, {id.e[0], id.e[1], id.e[2]});
    }
    case EntryParameter::kGroupId:
      return put_numbers(to, type, {group.group_id[0], group.group_id[1], group.group_id[2]});
    case EntryParameter::kGroupThreadId:
      return put_numbers(to, type, {thread[0], thread[1], thread[2]});
    default:
      return put_numbers(to, type, {thread[0] + size[0] * (thread[1] + size[1] * thread[2]), 0, 0});
  }
}

void put_parameter(const EntryCode& entry, size_t i, Frame& frame, const Arguments& arguments) {
  const ir::Variable& variable = *entry.code->function->parameters[i];
  const uint32_t bytes = entry.code->parameter_bytes[i];
  std::byte* to = frame.variables + entry.code->parameters[i];
  std::memset(to, 0, variable.mode == ir::ParameterMode::kIn ? bytes : 8);
  switch (entry.entry->parameters[i]) {
    case EntryParameter::kPayload:
    case EntryParameter::kCallableData:
      if (variable.mode == ir::ParameterMode::kIn) {
        std::memcpy(to, arguments.payload, bytes);
      } else {
        std::memcpy(to, &arguments.payload, sizeof(arguments.payload));
        if (variable.mode == ir::ParameterMode::kOut) std::memset(arguments.payload, 0, bytes);
      }
      break;
    case EntryParameter::kAttributes:
      std::memcpy(to, arguments.attributes, bytes);
      break;
    case EntryParameter::kInput: {
      const ir::SignatureElement& element = entry.entry->inputs[i];
      if (arguments.geometry != nullptr) {
        const bool of_corners = variable.type->kind == ir::TypeKind::kArray;
        const uint32_t corners = of_corners ? variable.type->count : 1;
        const uint32_t* from = arguments.geometry->rows + element.first_column;
        for (uint32_t corner = 0; corner < corners; ++corner) {
          std::memcpy(to + bytes / corners * corner, from + corner * arguments.geometry->columns,
                      element.components * sizeof(uint32_t));
        }
        break;
      }
      for (uint32_t c = 0; c < element.components; ++c) {
        std::memcpy(to + c * sizeof(uint32_t),
                    &arguments.inputs[element.first_column + c][arguments.lane], sizeof(uint32_t));
      }
      break;
    }
    case EntryParameter::kOutput: {
      std::byte* const place = frame.context->outputs + entry.output_offsets[i];
      std::memset(place, 0, bytes);
      std::memcpy(to, &place, sizeof(place));
      break;
    }
    case EntryParameter::kStaysLive:
      std::memcpy(to, &frame.context->stays_live, sizeof(frame.context->stays_live));
      break;
    case EntryParameter::kIsLive:
      std::memcpy(to, &arguments.is_live, sizeof(arguments.is_live));
      break;
    default:
      put_compute_value(entry.entry->parameters[i], to, variable.type, *frame.context->group,
                        arguments);
      break;
  }
}

[[gnu::noinline]] void initialise_statics(const EntryCode& entry, Context& context) {
  Frame frame;
  frame.context = &context;
  frame.temporaries = static_cast<std::byte*>(alloca(entry.temporary_bytes + 16));
  for (const StaticInitialiser& each : entry.statics) {
    std::byte* to = context.statics + each.offset;
    if (each.value != nullptr) {
      std::memcpy(to, evaluate(*each.value, frame), each.bytes);
    } else {
      std::memset(to, 0, each.bytes);
    }
  }
}

void put_outputs(const EntryCode& entry, const Context& context, const Arguments& arguments) {
  const size_t first = entry.entry->inputs.size();
  for (size_t i = 0; i < entry.entry->outputs.size(); ++i) {
    const ir::SignatureElement& element = entry.entry->outputs[i];
    const std::byte* const from = context.outputs + entry.output_offsets[first + i];
    for (uint32_t c = 0; c < element.components; ++c) {
      std::memcpy(&arguments.outputs[element.first_column + c][arguments.lane],
                  from + c * sizeof(uint32_t), sizeof(uint32_t));
    }
  }
}

// Not inlined into a loop over threads, because its memory is released only when it returns.
[[gnu::noinline]] void run_entry(const EntryCode& entry, Context& context,
                                 const Arguments& arguments) {
  const Program& program = *context.program;
  context.entry = entry.entry;
  context.steps_left = program.options.step_limit;
  context.statics = static_cast<std::byte*>(alloca(entry.static_bytes + 16));
  context.path = static_cast<uint32_t*>(alloca((entry.path_words + 1) * sizeof(uint32_t)));
  if (!entry.statics.empty()) initialise_statics(entry, context);
  Frame frame;
  frame.context = &context;
  frame.variables = static_cast<std::byte*>(alloca(entry.code->variable_bytes + 16));
  frame.temporaries = static_cast<std::byte*>(alloca(entry.code->temporary_bytes + 16));
  context.outputs = static_cast<std::byte*>(alloca(entry.output_bytes + 16));
  for (size_t i = 0; i < entry.entry->parameters.size(); ++i) {
    put_parameter(entry, i, frame, arguments);
  }
  run_body(*entry.code, frame);
  if (arguments.outputs != nullptr) put_outputs(entry, context, arguments);
}

}  // namespace

shader::AnyHitResult run_ray_entry(const Program& program, const EntryCode& entry,
                                   shader::Invocation& invocation, void* payload,
                                   const void* attributes) {
  Context context;
  context.program = &program;
  context.invocation = &invocation;
  if (program.checked && entry.entry->payload != nullptr && payload != nullptr) {
    shader::checked::check_payload(invocation, site_of(entry.entry->function->location), payload,
                                   type_hash(entry.entry->payload), entry.payload_bytes,
                                   entry.entry->stage == ir::kStageCallable);
  }
  run_entry(entry, context, {payload, attributes, nullptr, nullptr});
  return context.any_hit;
}

void run_compute_thread(const Program& program, const EntryCode& entry,
                        shader::Invocation& invocation, shader::ComputeGroup& group,
                        const uint32_t thread[3]) {
  Context context;
  context.program = &program;
  context.invocation = &invocation;
  context.group = &group;
  context.shared = static_cast<std::byte*>(group.shared);
  run_entry(entry, context, {nullptr, nullptr, thread, entry.entry->thread_group});
}

void run_vertex(const Program& program, const EntryCode& entry, shader::Invocation& invocation,
                const shader::VertexLanes& lanes, uint32_t lane) {
  Context context;
  context.program = &program;
  context.invocation = &invocation;
  Arguments arguments;
  arguments.inputs = lanes.inputs;
  arguments.outputs = lanes.outputs;
  arguments.lane = lane;
  run_entry(entry, context, arguments);
}

void run_geometry(const Program& program, const EntryCode& entry, shader::Invocation& invocation,
                  const shader::GeometryInputs& inputs, shader::GeometryStream& stream) {
  Context context;
  context.program = &program;
  context.invocation = &invocation;
  context.stream = &stream;
  Arguments arguments;
  arguments.geometry = &inputs;
  run_entry(entry, context, arguments);
}

void run_pixel(const Program& program, const EntryCode& entry, shader::Invocation& invocation,
               shader::PixelLanes& lanes, shader::ComputeGroup* group, uint32_t lane) {
  Context context;
  context.program = &program;
  context.invocation = &invocation;
  context.group = group;
  bool stays_live = false;
  context.stays_live = &stays_live;
  Arguments arguments;
  arguments.inputs = lanes.inputs;
  arguments.outputs = lanes.outputs;
  arguments.lane = lane;
  arguments.is_live = (lanes.live >> lane & 1u) != 0;
  run_entry(entry, context, arguments);
  if (!stays_live) lanes.live &= ~(1u << lane);
}

}  // namespace kaamos::hlsl::interpret
