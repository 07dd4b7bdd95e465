// SPDX-License-Identifier: MIT
#include "runtime/operations/partitioned_top_level.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>
#include <variant>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/operations/notes.h"
#include "runtime/operations/operation_sizes.h"

namespace kaamos::runtime {
namespace {

using rtapi::HasAny;
using rtapi::RtasPartitionedTlasInstanceFlags;
using OperationType = rtapi::RtasPartitionedTlasOperationType;
using WriteArgs = rtapi::RtasPartitionedTlasWriteInstanceArgs;
using UpdateArgs = rtapi::RtasPartitionedTlasUpdateInstanceArgs;
using TranslateArgs = rtapi::RtasPartitionedTlasTranslatePartitionArgs;

constexpr uint32_t kGlobal = rtapi::kRtasPartitionIndexGlobalPartition;
constexpr uint32_t kContributionMask = 0xFFFFFF;
constexpr size_t kOperationTypes = 3;

// One operation's arguments in GPU memory.
struct Arguments {
  uint32_t count = 0;
  const uint8_t* first = nullptr;
  uint64_t stride = 0;

  template <class Args>
  Args read(uint32_t index) const {
    Args args;
    std::memcpy(&args, first + index * stride, sizeof(args));
    return args;
  }
};

class Builder {
 public:
  Builder(const StructureEnvironment& environment, const RtasOperation& operation,
          OperationNotes& notes)
      : environment_(environment),
        addresses_(*environment.context.addresses),
        data_(operation.partitioned),
        inputs_(std::get<rtapi::RtasPartitionedTlasInputsDesc>(operation.inputs)),
        notes_(notes) {}

  rtapi::Status run(const RebuildLevel& build, std::vector<RtasResult>& results);

 private:
  // False: the operation is left out.
  bool start();
  void resize();
  void read_operations();
  bool read_arguments(const rtapi::RtasPartitionedTlasOperation& operation, Arguments& out);
  void write(const Arguments& arguments);
  void update(const Arguments& arguments);
  void translate(const Arguments& arguments);
  void check_write(uint32_t index, WriteArgs& args);
  void check_explicit_box(uint32_t index);
  void disable_removed_members();
  void count(const PartitionedInstance& slot, uint32_t change);
  void check_members();
  void activate_changed();
  void activate(uint32_t index);
  void mark(uint32_t index);
  RtasResult result() const;  // for checked mode
  bool in_place() const {
    return data_.SourceAccelerationStructureData == data_.DestAccelerationStructureData;
  }
  std::string at(uint64_t address) const { return at_address(addresses_, address); }

  const StructureEnvironment& environment_;
  const AddressMap& addresses_;
  rtapi::RtasPartitionedTlasOperationData data_;
  rtapi::RtasPartitionedTlasInputsDesc inputs_;
  OperationNotes& notes_;
  std::shared_ptr<const AccelerationStructure> source_;
  std::shared_ptr<PartitionedTopLevel> level_;
  std::vector<uint32_t> changed_;
  std::vector<uint8_t> is_changed_;  // by instance
  std::vector<uint8_t> is_written_;  // by instance: by WRITE_INSTANCE of this operation
  std::vector<uint8_t> is_updated_;  // by instance: by UPDATE_INSTANCE of this operation
  bool lost_partitions_ = false;     // there are fewer than before
};

bool Builder::start() {
  const uint64_t source = data_.SourceAccelerationStructureData;
  const uint64_t dest = data_.DestAccelerationStructureData;
  if (source == 0) {
    level_ = std::make_shared<PartitionedTopLevel>();
    return true;
  }
  source_ = environment_.structures.find(source);
  notes_.reads(source, source_ == nullptr ? 1 : source_->size_bytes, "source");
  if (source_ == nullptr || source_->partitioned == nullptr) {
    notes_.add("there is no partitioned top level " + at(source) +
               " to start from, so the operation is left out");
    return false;
  }
  const uint64_t bytes = partitioned_bytes(inputs_);
  const bool overlaps = source < dest ? dest - source < source_->size_bytes : source - dest < bytes;
  if (!in_place() && overlaps) {
    notes_.add("source " + at(source) + " and destination " + at(dest) +
               " overlap; they must be the same or apart");
  }
  // In place it changes the state itself, which no other structure shares.
  level_ = in_place() ? std::const_pointer_cast<PartitionedTopLevel>(source_->partitioned)
                      : std::make_shared<PartitionedTopLevel>(*source_->partitioned);
  return true;
}

void Builder::mark(uint32_t index) {
  if (std::exchange(is_changed_[index], uint8_t{1}) == 0) changed_.push_back(index);
}

// Counts may change from build to build, and so may whether partitions have translations.
void Builder::resize() {
  const uint32_t count = inputs_.InstanceCount;
  const auto before = static_cast<uint32_t>(level_->slots.size());
  const bool had_translations = level_->translates();
  is_changed_.assign(count, 0);
  is_written_.assign(count, 0);
  is_updated_.assign(count, 0);
  lost_partitions_ = inputs_.PartitionCount < level_->inputs.PartitionCount;
  if (count != before || level_->members.size() != size_t{inputs_.PartitionCount} + 1) {
    level_->members.clear();  // counted anew at the end
  }
  level_->slots.resize(count);
  level_->instances.resize(count);
  for (uint32_t i = before; i < count; ++i) mark(i);
  level_->inputs = inputs_;
  if (had_translations && !level_->translates()) {
    for (uint32_t i = 0; i < std::min(before, count); ++i) mark(i);
    level_->translations.clear();
    level_->global_translation = {};
  }
  if (level_->translates()) level_->translations.resize(inputs_.PartitionCount, Translation{});
}

void Builder::read_operations() {
  const uint64_t count_address = data_.IndirectPartitionedTlasOpCount;
  if (!addresses_.contains(count_address, sizeof(uint32_t))) {
    return notes_.add("the number of operations is " + at(count_address) +
                      ", where no live buffer has 4 bytes; it is taken as 0");
  }
  uint32_t count;
  std::memcpy(&count, addresses_.host(count_address), sizeof(count));
  if (count > kOperationTypes) {
    notes_.add("there are " + std::to_string(count) +
               " operations, but at most one of each of the 3 types; the others are left out");
    count = kOperationTypes;
  }
  if (count == 0) return;
  const uint64_t address = data_.IndirectPartitionedTlasOps;
  using Operation = rtapi::RtasPartitionedTlasOperation;
  if (!addresses_.contains(address, count * sizeof(Operation))) {
    return notes_.add(std::to_string(count) + " operations " + at(address) + " need " +
                      std::to_string(count * sizeof(Operation)) + " bytes, but the buffer has " +
                      std::to_string(addresses_.bytes_from(address)) +
                      " from there on; they are left out");
  }
  std::optional<Arguments> found[kOperationTypes];
  for (uint32_t i = 0; i < count; ++i) {
    Operation operation;
    std::memcpy(&operation, addresses_.host(address) + i * sizeof(operation), sizeof(operation));
    const auto type = static_cast<uint32_t>(operation.Type);
    Arguments arguments;
    if (!read_arguments(operation, arguments)) continue;
    if (found[type]) {
      notes_.add("operation " + std::to_string(i) + " is another of type " + std::to_string(type) +
                 "; it replaces the one before");
    }
    found[type] = arguments;
  }
  // The order in memory does not count.
  const auto run = [&](OperationType type, void (Builder::*apply)(const Arguments&)) {
    if (const auto& arguments = found[static_cast<size_t>(type)]) (this->*apply)(*arguments);
  };
  run(OperationType::kTranslatePartition, &Builder::translate);
  run(OperationType::kWriteInstance, &Builder::write);
  run(OperationType::kUpdateInstance, &Builder::update);
}

bool Builder::read_arguments(const rtapi::RtasPartitionedTlasOperation& operation, Arguments& out) {
  const auto type = static_cast<uint32_t>(operation.Type);
  if (operation.Type > OperationType::kTranslatePartition) {
    notes_.add("an operation has type " + std::to_string(type) +
               "; it must be 0, 1 or 2, and is left out");
    return false;
  }
  constexpr uint64_t kSizes[kOperationTypes] = {sizeof(WriteArgs), sizeof(UpdateArgs),
                                                sizeof(TranslateArgs)};
  const uint64_t alignment = operation.Type == OperationType::kTranslatePartition ? 4 : 8;
  const uint64_t bytes = kSizes[type];
  out.count = operation.ArgCount;
  out.stride = operation.ArgData.StrideInBytes == 0 ? bytes : operation.ArgData.StrideInBytes;
  if (out.count == 0) return true;
  const std::string what = "the arguments of type " + std::to_string(type) + " ";
  if (operation.ArgData.StartAddress % alignment != 0 || out.stride % alignment != 0) {
    notes_.add(what + at(operation.ArgData.StartAddress) + " have stride " +
               std::to_string(out.stride) + "; address and stride must be multiples of " +
               std::to_string(alignment) + ", so they are left out");
    return false;
  }
  const uint64_t available = addresses_.bytes_from(operation.ArgData.StartAddress);
  const bool fits = available >= bytes && (available - bytes) / out.stride >= out.count - 1u;
  if (!fits) {
    notes_.add(what + at(operation.ArgData.StartAddress) + " are " + std::to_string(out.count) +
               " with stride " + std::to_string(out.stride) + ", but the buffer has " +
               std::to_string(available) + " bytes from there on; they are left out");
    return false;
  }
  out.first = addresses_.host(operation.ArgData.StartAddress);
  notes_.reads(operation.ArgData.StartAddress, (out.count - 1) * out.stride + bytes, "arguments");
  return true;
}

void Builder::check_write(uint32_t index, WriteArgs& args) {
  const std::string where = "WRITE_INSTANCE of instance " + std::to_string(index) + ": ";
  if (args.InstanceMask > 0xFF) {
    notes_.add(where + "InstanceMask is " + std::to_string(args.InstanceMask) +
               "; only the low 8 bits count");
    args.InstanceMask &= 0xFF;
  }
  if (args.InstanceContributionToHitGroupIndex > kContributionMask) {
    notes_.add(where + "InstanceContributionToHitGroupIndex is " +
               std::to_string(args.InstanceContributionToHitGroupIndex) +
               "; only the low 24 bits count");
    args.InstanceContributionToHitGroupIndex &= kContributionMask;
  }
  const auto flags = static_cast<uint32_t>(args.InstanceFlags);
  constexpr uint32_t kBoth = kInstanceForceOpaque | kInstanceForceNonOpaque;
  if (flags > 0x7F || (flags & kBoth) == kBoth) {
    notes_.add(where + "InstanceFlags are " + std::to_string(flags) +
               (flags > 0x7F ? "; only the bits of 0x7F are defined"
                             : ", with both FORCE_OPAQUE and FORCE_NON_OPAQUE"));
  }
}

void Builder::write(const Arguments& arguments) {
  for (uint32_t i = 0; i < arguments.count; ++i) {
    auto args = arguments.read<WriteArgs>(i);
    const uint32_t index = args.InstanceIndex;
    if (index >= inputs_.InstanceCount) {
      notes_.add("WRITE_INSTANCE argument " + std::to_string(i) + ": InstanceIndex is " +
                 std::to_string(index) + ", but InstanceCount is " +
                 std::to_string(inputs_.InstanceCount) + "; it is left out");
      continue;
    }
    if (args.PartitionIndex != kGlobal && args.PartitionIndex >= inputs_.PartitionCount) {
      notes_.add("WRITE_INSTANCE of instance " + std::to_string(index) + ": PartitionIndex is " +
                 std::to_string(args.PartitionIndex) + ", but PartitionCount is " +
                 std::to_string(inputs_.PartitionCount) + "; it is left out");
      continue;
    }
    check_write(index, args);
    if (std::exchange(is_written_[index], uint8_t{1}) != 0) {
      notes_.add("instance " + std::to_string(index) +
                 " is written twice by one operation; the last argument counts");
    }
    count(level_->slots[index], ~0u);
    level_->slots[index] = {args, true};
    count(level_->slots[index], 1);
    mark(index);
  }
}

void Builder::update(const Arguments& arguments) {
  for (uint32_t i = 0; i < arguments.count; ++i) {
    const auto args = arguments.read<UpdateArgs>(i);
    const uint32_t index = args.InstanceIndex;
    const auto leave_out = [&](const std::string& why) {
      notes_.add("UPDATE_INSTANCE argument " + std::to_string(i) + ": " + why + "; it is left out");
    };
    if (index >= inputs_.InstanceCount) {
      leave_out("InstanceIndex is " + std::to_string(index) + ", but InstanceCount is " +
                std::to_string(inputs_.InstanceCount));
      continue;
    }
    PartitionedInstance& slot = level_->slots[index];
    const bool boxed =
        HasAny(slot.args.InstanceFlags, RtasPartitionedTlasInstanceFlags::kEnableExplicitAabb);
    if (args.AccelerationStructure == 0) {
      leave_out("AccelerationStructure is 0");
      continue;
    }
    if (is_written_[index] != 0) {
      leave_out("instance " + std::to_string(index) + " is written by the same operation");
      continue;
    }
    if (!slot.written || (!boxed && slot.args.AccelerationStructure == 0)) {
      leave_out("instance " + std::to_string(index) +
                (slot.written ? " was last written without a bottom level and without an explicit "
                                "AABB"
                              : " was never written"));
      continue;
    }
    if (args.InstanceContributionToHitGroupIndex > kContributionMask) {
      notes_.add("UPDATE_INSTANCE argument " + std::to_string(i) +
                 ": InstanceContributionToHitGroupIndex is " +
                 std::to_string(args.InstanceContributionToHitGroupIndex) +
                 "; only the low 24 bits count");
    }
    if (std::exchange(is_updated_[index], uint8_t{1}) != 0) {
      notes_.add("instance " + std::to_string(index) +
                 " is updated twice by one operation; the last argument counts");
    }
    slot.args.AccelerationStructure = args.AccelerationStructure;
    slot.args.InstanceContributionToHitGroupIndex =
        args.InstanceContributionToHitGroupIndex & kContributionMask;
    mark(index);
  }
}

void Builder::translate(const Arguments& arguments) {
  if (arguments.count == 0) return;
  if (!level_->translates()) {
    return notes_.add(
        "TRANSLATE_PARTITION needs kEnablePartitionTranslation in the inputs' flags; "
        "it is left out");
  }
  std::vector<uint8_t> seen(size_t{inputs_.PartitionCount} + 1, 0);
  bool global = false;
  for (uint32_t i = 0; i < arguments.count; ++i) {
    const auto args = arguments.read<TranslateArgs>(i);
    const bool is_global = args.PartitionIndex == kGlobal;
    if (!is_global && args.PartitionIndex >= inputs_.PartitionCount) {
      notes_.add("TRANSLATE_PARTITION argument " + std::to_string(i) + ": PartitionIndex is " +
                 std::to_string(args.PartitionIndex) + ", but PartitionCount is " +
                 std::to_string(inputs_.PartitionCount) + "; it is left out");
      continue;
    }
    Translation& translation =
        is_global ? level_->global_translation : level_->translations[args.PartitionIndex];
    std::copy_n(args.PartitionTranslation, 3, translation.begin());
    uint8_t& was_seen = seen[is_global ? inputs_.PartitionCount : args.PartitionIndex];
    if (std::exchange(was_seen, uint8_t{1}) != 0) {
      notes_.add("partition " + std::to_string(args.PartitionIndex) +
                 " is translated twice by one operation; the last argument counts");
    }
    global |= is_global;
  }
  for (uint32_t i = 0; i < inputs_.InstanceCount; ++i) {
    const PartitionedInstance& slot = level_->slots[i];
    if (!slot.written) continue;
    const uint32_t partition = slot.args.PartitionIndex;
    const bool moved =
        partition == kGlobal ? global : partition < inputs_.PartitionCount && seen[partition] != 0;
    if (moved) mark(i);
  }
}

// An instance of a partition that is no more must be written anew when the partition goes.
void Builder::disable_removed_members() {
  if (!lost_partitions_) return;
  for (uint32_t i = 0; i < inputs_.InstanceCount; ++i) {
    PartitionedInstance& slot = level_->slots[i];
    const uint32_t partition = slot.args.PartitionIndex;
    if (!slot.written || partition == kGlobal || partition < inputs_.PartitionCount) continue;
    notes_.add("instance " + std::to_string(i) + " is in partition " + std::to_string(partition) +
               ", but PartitionCount is now " + std::to_string(inputs_.PartitionCount) +
               "; it is disabled until it is written again");
    slot = {};
    mark(i);
  }
}

void Builder::count(const PartitionedInstance& slot, uint32_t change) {
  if (level_->members.empty() || !slot.written || is_degenerate(slot.args.Transform)) return;
  level_->members[level_->place_of(slot.args.PartitionIndex)] += change;
}

void Builder::check_members() {
  std::vector<uint32_t>& members = level_->members;
  if (members.empty()) {
    members.resize(size_t{inputs_.PartitionCount} + 1);
    for (const PartitionedInstance& slot : level_->slots) count(slot, 1);
  }
  for (uint32_t i = 0; i <= inputs_.PartitionCount; ++i) {
    const bool global = i == inputs_.PartitionCount;
    const uint32_t most =
        global ? inputs_.MaxInstanceInGlobalPartitionCount : inputs_.MaxInstancePerPartitionCount;
    if (members[i] <= most) continue;
    notes_.add((global ? "the global partition" : "partition " + std::to_string(i)) + " has " +
               std::to_string(members[i]) + " instances, but the inputs allow " +
               std::to_string(most) + "; they are kept");
  }
}

void Builder::activate(uint32_t index) {
  const char* why = runtime::activate(environment_.structures, *level_, index);
  const Instance& instance = level_->instances[index];
  notes_.reads(instance.desc.AccelerationStructure, 1, "bottom level");
  if (why != nullptr) {
    notes_.add("instance " + std::to_string(index) + ": " + why, Id::kInstanceInactive);
  }
}

// For checked mode only, since it reads every vertex.
void Builder::check_explicit_box(uint32_t index) {
  const WriteArgs& args = level_->slots[index].args;
  const auto& level = level_->instances[index].bottom_level;
  if (level == nullptr ||
      !HasAny(args.InstanceFlags, RtasPartitionedTlasInstanceFlags::kEnableExplicitAabb)) {
    return;
  }
  const rtapi::RaytracingAabb& box = args.ExplicitAABB;
  const float lower[3] = {box.MinX, box.MinY, box.MinZ};
  const float upper[3] = {box.MaxX, box.MaxY, box.MaxZ};
  double excess = 0;
  const auto take = [&](const float* point) {
    for (int row = 0; row < 3; ++row) {
      const float* m = args.Transform[row];
      const auto x = static_cast<float>(double{m[0]} * point[0] + double{m[1]} * point[1] +
                                        double{m[2]} * point[2] + m[3]);
      excess = std::max({excess, double{lower[row]} - x, double{x} - upper[row]});
    }
  };
  const auto shapes = level->geometry_shapes();
  for (uint32_t g = 0; g < shapes.size(); ++g) {
    const GeometryContents contents = level->geometry_contents(g);
    for (size_t i = 0; i + 2 < contents.xyz.size(); i += 3) take(&contents.xyz[i]);
    for (const rtapi::RaytracingAabb& b : contents.boxes) {
      for (int corner = 0; corner < 8; ++corner) {
        const float point[3] = {(corner & 1) != 0 ? b.MaxX : b.MinX,
                                (corner & 2) != 0 ? b.MaxY : b.MinY,
                                (corner & 4) != 0 ? b.MaxZ : b.MinZ};
        take(point);
      }
    }
  }
  if (excess <= 0) return;
  notes_.add("instance " + std::to_string(index) + " reaches " + std::to_string(excess) +
             " outside of its ExplicitAABB; rays may miss what is there");
}

void Builder::activate_changed() {
  const bool checked = environment_.context.reporter != nullptr;
  for (const uint32_t index : changed_) {
    activate(index);
    if (checked) check_explicit_box(index);
  }
}

RtasResult Builder::result() const {
  RtasResult out;
  out.address = data_.DestAccelerationStructureData;
  out.size_bytes = partitioned_bytes(inputs_);
  out.source = data_.SourceAccelerationStructureData;
  out.top_level = true;
  if (environment_.context.reporter == nullptr) return out;
  out.instances.reserve(level_->instances.size());
  for (uint32_t i = 0; i < level_->instances.size(); ++i) {
    const rtapi::RaytracingInstanceDesc& desc = level_->instances[i].desc;
    out.instances.push_back({desc.AccelerationStructure, desc.InstanceContributionToHitGroupIndex,
                             desc.InstanceMask, desc.Flags});
    if (is_written_[i] != 0 || is_updated_[i] != 0) out.written.push_back(i);
  }
  return out;
}

rtapi::Status Builder::run(const RebuildLevel& build, std::vector<RtasResult>& results) {
  const uint64_t dest = data_.DestAccelerationStructureData;
  const uint64_t bytes = partitioned_bytes(inputs_);
  if (auto s = check_destination(addresses_, dest, bytes); !s) return s;
  if (!start()) return {};
  resize();
  read_operations();
  disable_removed_members();
  check_members();
  activate_changed();
  AccelerationStructure result;
  result.address = dest;
  result.host = addresses_.host(dest);
  result.size_bytes = bytes;
  result.compacted_bytes = bytes;
  result.instance_count = inputs_.InstanceCount;
  result.partitioned = level_;
  if (source_ != nullptr && in_place()) result.top_level = source_->top_level;
  if (auto s = build_partitioned_level(build, *level_, changed_, result); !s) return s;
  environment_.structures.place(std::move(result));
  notes_.writes(dest, bytes, "result");
  results.push_back(this->result());
  return {};
}

}  // namespace

rtapi::Status build_partitioned(const StructureEnvironment& environment,
                                const RtasOperation& operation, OperationNotes& notes,
                                const RebuildLevel& build, std::vector<RtasResult>& results) {
  return Builder(environment, operation, notes).run(build, results);
}

}  // namespace kaamos::runtime
