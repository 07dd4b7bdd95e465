// SPDX-License-Identifier: MIT
//
// Writes described tables as text and as JSON.
#include <cstring>
#include <nlohmann/json.hpp>

#include "rtapi/src/explain/address_text.h"

namespace rtapi {

using namespace detail;

namespace {

using Json = nlohmann::ordered_json;

const char* state_text(TableRecordState state) {
  switch (state) {
    case TableRecordState::kNull:
      return "null";
    case TableRecordState::kKnown:
      return "known";
    case TableRecordState::kWrongTable:
      return "wrong table";
    case TableRecordState::kUnknown:
      return "unknown identifier";
    case TableRecordState::kUnreadable:
      return "unreadable";
  }
  return "";
}

std::string join(const std::vector<std::string>& words, const char* between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

// A constant may be an integer or a float; the float is shown too if it has a plausible size.
std::string constant_text(uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  const float size = value < 0 ? -value : value;
  if (size >= 1e-6f && size <= 1e9f) return concat(bits, " (", value, ")");
  return concat(bits);
}

std::string argument_text(const TableArgument& argument) {
  switch (argument.Type) {
    case RootParameterType::k32BitConstants: {
      std::string text = "constants";
      for (const uint32_t c : argument.Constants) text += " " + constant_text(c);
      return text;
    }
    case RootParameterType::kDescriptorTable:
      if (!argument.HandleIsLive) {
        return concat("descriptor table at ", hex(argument.Handle), " (in no live heap)");
      }
      return concat("descriptor table at ", named("heap", argument.Heap), " slot ", argument.Slot);
    case RootParameterType::kCbv:
      return "root CBV, " + ToText(argument.Address);
    case RootParameterType::kSrv:
      return "root SRV, " + ToText(argument.Address);
    case RootParameterType::kUav:
      return "root UAV, " + ToText(argument.Address);
  }
  return "";
}

std::string record_title(const DescribedTable& table, const TableRecord& record) {
  switch (record.State) {
    case TableRecordState::kNull:
      return "NULL identifier: nothing runs";
    case TableRecordState::kUnknown:
      return "no identifier of this state object: nothing runs";
    case TableRecordState::kUnreadable:
      return "cannot be read";
    case TableRecordState::kWrongTable:
      return concat(in_quotes(record.Export), ", which belongs in another table: nothing runs");
    case TableRecordState::kKnown:
      break;
  }
  std::string text = in_quotes(record.Export);
  if (table.Name != "hit group") return text;
  const auto add = [&](const char* what, const std::string& name) {
    if (!name.empty()) text += concat(", ", what, " ", in_quotes(name));
  };
  add("intersection", record.IntersectionShader);
  add("any-hit", record.AnyHitShader);
  add("closest-hit", record.ClosestHitShader);
  return text;
}

std::string ray_type_text(const TableDescription& d, uint32_t type) {
  const std::string& name = d.RayTypes[type].Name;
  return name.empty() ? concat("ray type ", type) : concat("ray type ", type, " ", in_quotes(name));
}

std::string reach_text(const TableDescription& d, const DescribedTable& table,
                       const TableReach& reach) {
  if (table.Name != "hit group") return ray_type_text(d, reach.RayType);
  return concat("instance ", reach.InstanceIndex, " (ID ", reach.InstanceID, "), geometry ",
                reach.GeometryIndex, ", ", ray_type_text(d, reach.RayType));
}

void add_record(const TableDescription& d, const DescribedTable& table, const TableRecord& record,
                std::string& out) {
  out += concat("  record ", record.Index, " at + ", record.Index * table.StrideInBytes, ": ",
                record_title(table, record), "\n");
  for (const TableArgument& argument : record.Arguments) {
    out += concat("    + ", argument.OffsetInBytes, " ", join(argument.Registers, " | "));
    if (!argument.Names.empty()) out += concat(" ", in_quotes(join(argument.Names, "\", \"")));
    out += concat(": ", argument_text(argument), "\n");
    for (const DescriptorDescription& descriptor : argument.Descriptors) {
      out += concat("      slot ", descriptor.Slot, ": ", ToText(descriptor), "\n");
    }
    if (argument.DescriptorsLeftOut != 0) {
      out += concat("      and ", argument.DescriptorsLeftOut, " more\n");
    }
  }
  for (const TableReach& reach : record.ReachedBy) {
    out += concat("    reached by ", reach_text(d, table, reach), "\n");
  }
  if (record.ReachCount > record.ReachedBy.size()) {
    out += concat("    and ", record.ReachCount - record.ReachedBy.size(), " more\n");
  }
}

Json to_json_value(const AddressDescription& address) {
  Json json;
  json["address"] = hex(address.Address);
  json["live"] = address.Live;
  if (!address.Live) return json;
  json["buffer"] = address.Buffer;
  json["offset"] = address.OffsetInBytes;
  json["buffer_bytes"] = address.SizeInBytes;
  return json;
}

Json to_json_value(const DescriptorDescription& d) {
  Json json = {{"slot", d.Slot}, {"kind", d.Kind}, {"access", d.Access}, {"resource", d.Resource}};
  if (d.StrideInBytes != 0) json["stride"] = d.StrideInBytes;
  if (d.SizeInBytes != 0) json["bytes"] = d.SizeInBytes;
  if (d.Address.Address != 0) json["at"] = to_json_value(d.Address);
  return json;
}

const char* type_name(RootParameterType type) {
  switch (type) {
    case RootParameterType::kDescriptorTable:
      return "descriptor table";
    case RootParameterType::k32BitConstants:
      return "constants";
    case RootParameterType::kCbv:
      return "root CBV";
    case RootParameterType::kSrv:
      return "root SRV";
    case RootParameterType::kUav:
      return "root UAV";
  }
  return "";
}

Json to_json_value(const TableArgument& argument) {
  Json json = {{"type", type_name(argument.Type)},
               {"offset", argument.OffsetInBytes},
               {"registers", argument.Registers},
               {"names", argument.Names}};
  if (argument.Type == RootParameterType::k32BitConstants) {
    json["values"] = argument.Constants;
  } else if (argument.Type == RootParameterType::kDescriptorTable) {
    json["handle"] = hex(argument.Handle);
    json["live"] = argument.HandleIsLive;
    json["heap"] = argument.Heap;
    json["slot"] = argument.Slot;
    json["descriptors"] = Json::array();
    for (const auto& d : argument.Descriptors) json["descriptors"].push_back(to_json_value(d));
    if (argument.DescriptorsLeftOut != 0) json["left_out"] = argument.DescriptorsLeftOut;
  } else {
    json["at"] = to_json_value(argument.Address);
  }
  return json;
}

Json to_json_value(const DescribedTable& table, const TableRecord& record) {
  Json json = {{"index", record.Index},
               {"state", state_text(record.State)},
               {"at", to_json_value(record.Address)}};
  if (!record.Export.empty()) json["export"] = record.Export;
  const auto add = [&](const char* key, const std::string& name) {
    if (!name.empty()) json[key] = name;
  };
  add("shader", record.Shader);
  add("intersection", record.IntersectionShader);
  add("any_hit", record.AnyHitShader);
  add("closest_hit", record.ClosestHitShader);
  json["arguments"] = Json::array();
  for (const auto& argument : record.Arguments)
    json["arguments"].push_back(to_json_value(argument));
  json["reach_count"] = record.ReachCount;
  json["reached_by"] = Json::array();
  for (const TableReach& reach : record.ReachedBy) {
    Json each = {{"ray_type", reach.RayType}};
    if (table.Name == "hit group") {
      each["instance"] = reach.InstanceIndex;
      each["instance_id"] = reach.InstanceID;
      each["geometry"] = reach.GeometryIndex;
    }
    json["reached_by"].push_back(std::move(each));
  }
  return json;
}

}  // namespace

std::string ToText(const TableDescription& d) {
  std::string out;
  for (const DescribedTable& table : d.Tables) {
    const size_t count = table.Records.size() + table.RecordsLeftOut;
    out += concat(table.Name, " table: ", count, count == 1 ? " record" : " records");
    if (table.StrideInBytes != 0) out += concat(" every ", table.StrideInBytes, " bytes");
    out += concat(" at ", ToText(table.Address), "\n");
    for (const TableRecord& record : table.Records) add_record(d, table, record, out);
    if (table.RecordsLeftOut != 0) out += concat("  and ", table.RecordsLeftOut, " more\n");
  }
  for (const std::string& problem : d.Problems) out += concat("problem: ", problem, "\n");
  return out;
}

std::string ToJson(const TableDescription& d) {
  Json json;
  json["ray_types"] = Json::array();
  for (const RayTypeDesc& type : d.RayTypes) {
    json["ray_types"].push_back(
        {{"name", type.Name},
         {"ray_contribution", type.RayContributionToHitGroupIndex},
         {"geometry_multiplier", type.MultiplierForGeometryContributionToHitGroupIndex},
         {"miss_index", type.MissShaderIndex}});
  }
  json["tables"] = Json::array();
  for (const DescribedTable& table : d.Tables) {
    Json each = {{"name", table.Name},
                 {"at", to_json_value(table.Address)},
                 {"bytes", table.SizeInBytes},
                 {"stride", table.StrideInBytes}};
    each["records"] = Json::array();
    for (const auto& record : table.Records)
      each["records"].push_back(to_json_value(table, record));
    if (table.RecordsLeftOut != 0) each["left_out"] = table.RecordsLeftOut;
    json["tables"].push_back(std::move(each));
  }
  json["problems"] = d.Problems;
  // Names may contain bytes that are not UTF-8; replace them instead of throwing.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rtapi
