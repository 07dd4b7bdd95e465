// SPDX-License-Identifier: MIT
#include <rtapi/explain.h>

#include <cstring>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/commands/command_queue_impl.h"
#include "rtapi/src/commands/execute_held.h"
#include "rtapi/src/explain/host_textures.h"
#include "runtime/explain/replay.h"

namespace rtapi {

using namespace detail;

namespace {

constexpr char kReplayed[] =
    "shaders replayed on the CPU, candidates searched in double precision and offered front to "
    "back";

// Saves the memory that shaders may write, and restores it when it goes out of scope.
class Snapshot {
 public:
  explicit Snapshot(const runtime::AddressMap& addresses) {
    for (const runtime::Allocation& allocation : addresses.all()) {
      // Shaders never write acceleration structures. Scratch buffers are saved too, since nothing
      // tells them from other writable buffers.
      if (allocation.acceleration_structure || allocation.host == nullptr ||
          !HasAny(allocation.flags, ResourceFlags::kAllowUnorderedAccess)) {
        continue;
      }
      parts_.push_back(
          {allocation.host,
           std::vector<uint8_t>(allocation.host, allocation.host + allocation.size_bytes)});
    }
  }
  ~Snapshot() {
    // Writes back only pages that changed, because the rest may never have been touched.
    constexpr size_t kPage = 4096;
    for (const Part& part : parts_) {
      for (size_t at = 0; at < part.bytes.size(); at += kPage) {
        const size_t count = std::min(kPage, part.bytes.size() - at);
        if (std::memcmp(part.host + at, part.bytes.data() + at, count) != 0) {
          std::memcpy(part.host + at, part.bytes.data() + at, count);
        }
      }
    }
  }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

 private:
  struct Part {
    uint8_t* host;
    std::vector<uint8_t> bytes;
  };
  std::vector<Part> parts_;
};

struct Found {
  const runtime::DispatchRaysCommand* command = nullptr;
  size_t position = 0;
};

Result<Found> FindDispatch(const CommandVector& commands, const ExplainDesc& desc) {
  uint32_t seen = 0;
  for (size_t i = 0; i < commands.size(); ++i) {
    const auto* command = std::get_if<runtime::DispatchRaysCommand>(&commands[i]);
    if (command != nullptr && seen++ == desc.Dispatch) return Found{command, i};
  }
  return make_error(Id::kExplain, "Dispatch is ", desc.Dispatch, ", but the list has only ", seen,
                    " calls of DispatchRays");
}

Status CheckMemory(const DeviceImpl& device) {
  for (const runtime::Allocation& allocation : device.addresses.all()) {
    if (allocation.host != nullptr) continue;
    Error error = make_error(Id::kExplain, named("buffer", allocation.name),
                             " is in memory that the host cannot read, so its shaders cannot be "
                             "replayed; use the embree backend");
    error.code = ErrorCode::kUnsupported;
    return error;
  }
  return {};
}

// Executes `list`, and calls use(replay, command) just before the dispatch.
template <class Use>
Status ExecuteWith(const CommandQueue& queue, const CommandList& list, const ExplainDesc& desc,
                   const char* call, Use&& use) {
  if (Status s = prepare_explained(queue, list, call); !s.ok()) return s;
  const std::shared_ptr<DeviceImpl>& device = queue.impl()->device;
  const std::shared_ptr<const CommandVector> commands = list.impl()->commands;
  const auto found = FindDispatch(*commands, desc);
  if (!found.ok()) return found.error();
  if (Status s = CheckMemory(*device); !s.ok()) return s;

  const std::span<const runtime::Command> all = *commands;
  return execute_held(*device, *list.impl()->uses, [&]() -> Status {
    if (Status s = execute_commands(*device, all.first(found->position)); !s.ok()) return s;
    {
      const Snapshot snapshot(device->addresses);
      HostTextures textures(*device);
      kaamos::explain::Environment environment;
      environment.backend = device->backend.get();
      environment.addresses = &device->addresses;
      environment.texture = [&](const shader::Descriptor& d) { return textures.View(d); };
      environment.sampler = [&](const shader::Descriptor& d) { return textures.Sampler(d); };
      kaamos::explain::Replay replay(environment, *found->command);
      if (Status s = use(replay, *found->command); !s.ok()) return s;
    }
    return execute_commands(*device, all.subspan(found->position));
  });
}

}  // namespace

Result<PixelExplanation> ExplainPixel(const CommandQueue& queue, const CommandList& list,
                                      const ExplainDesc& desc) {
  PixelExplanation out;
  const Status done = ExecuteWith(
      queue, list, desc, "ExplainPixel",
      [&](kaamos::explain::Replay& replay, const runtime::DispatchRaysCommand& command) -> Status {
        const DispatchRaysDesc& d = command.desc;
        if (desc.X >= d.Width || desc.Y >= d.Height || desc.Z >= d.Depth) {
          return make_error(Id::kExplain, "index (", desc.X, ", ", desc.Y, ", ", desc.Z,
                            ") is outside the dispatch (", d.Width, " x ", d.Height, " x ", d.Depth,
                            ")");
        }
        out.Backend = queue.impl()->device->backend->info().Name;
        out.Executor = kReplayed;
        const uint32_t index[3] = {desc.X, desc.Y, desc.Z};
        replay.run(index, desc.MaxCandidatesPerRay, &out);
        return {};
      });
  // If the dispatch faults, the explanation is exactly what the caller wants: return it.
  if (!done.ok() && out.Removal.empty()) return done.error();
  return out;
}

Result<DispatchStatistics> CollectPixelStatistics(const CommandQueue& queue,
                                                  const CommandList& list,
                                                  const ExplainDesc& desc) {
  DispatchStatistics out;
  const Status done = ExecuteWith(
      queue, list, desc, "CollectPixelStatistics",
      [&](kaamos::explain::Replay& replay, const runtime::DispatchRaysCommand& command) -> Status {
        const DispatchRaysDesc& d = command.desc;
        out.Dimensions[0] = d.Width;
        out.Dimensions[1] = d.Height;
        out.Dimensions[2] = d.Depth;
        out.Executor = kReplayed;
        for (uint32_t z = 0; z < d.Depth; ++z) {
          for (uint32_t y = 0; y < d.Height; ++y) {
            for (uint32_t x = 0; x < d.Width; ++x) {
              const uint32_t index[3] = {x, y, z};
              out.Pixels.push_back(replay.run(index, 0, nullptr));
            }
          }
        }
        return {};
      });
  if (!done.ok()) return done.error();
  return out;
}

}  // namespace rtapi
