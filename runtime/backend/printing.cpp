// SPDX-License-Identifier: MIT
#include "runtime/backend/printing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <variant>

#include "runtime/backend/backend.h"
#include "runtime/backend/errors.h"
#include "runtime/shader/print_format.h"

namespace kaamos::runtime {
namespace {

uint32_t word_at(const uint8_t* bytes, uint32_t offset) {
  uint32_t word;
  std::memcpy(&word, bytes + offset, sizeof word);
  return word;
}
void set_word(uint8_t* bytes, uint32_t offset, uint32_t word) {
  std::memcpy(bytes + offset, &word, sizeof word);
}

// One scalar, of a type as in PrintDesc::arguments.
struct Number {
  char type;
  uint64_t bits;

  bool is_wide() const { return type == 'd' || type == 'l' || type == 'q'; }
  // The sign of NaN says nothing, and executors differ in it.
  double as_double() const {
    const double value = signed_double();
    return std::isnan(value) ? std::abs(value) : value;
  }
  // With its sign.
  int64_t as_integer() const {
    return type == 'i' ? static_cast<int32_t>(static_cast<uint32_t>(bits))
                       : static_cast<int64_t>(bits);
  }

 private:
  double signed_double() const {
    if (type == 'd') {
      double value;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
    float value;
    const auto low = static_cast<uint32_t>(bits);
    std::memcpy(&value, &low, sizeof value);
    return static_cast<double>(value);
  }
};

// The shortest text that gives the same value again.
template <class T>
std::string shortest(T value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string plain_text(const Number& number) {
  switch (number.type) {
    case 'b':
      return number.bits != 0 ? "true" : "false";
    case 'f':
      return shortest(static_cast<float>(number.as_double()));
    case 'd':
      return shortest(number.as_double());
    case 'i':
    case 'l':
      return std::to_string(number.as_integer());
    default:
      return std::to_string(number.bits);
  }
}

std::string number_text(const shader::PrintConversion& conversion, const Number& number) {
  if (conversion.letter == 'v') return plain_text(number);
  std::string format = "%" + std::string(conversion.spec);
  char text[512];
  if (conversion.letter == 'c') {
    format += 'c';
    std::snprintf(text, sizeof text, format.c_str(), static_cast<int>(number.bits & 0x7F));
  } else if (conversion.is_float()) {
    format += conversion.letter;
    std::snprintf(text, sizeof text, format.c_str(), number.as_double());
  } else {
    format += "ll";
    format += conversion.letter;
    const bool is_signed = conversion.letter == 'd' || conversion.letter == 'i';
    // An int printed as hexadecimal has 32 bits.
    const auto value = is_signed ? static_cast<unsigned long long>(number.as_integer())
                                 : static_cast<unsigned long long>(number.bits);
    std::snprintf(text, sizeof text, format.c_str(), value);
  }
  return text;
}

// Reads the values of a record one after another.
class Values {
 public:
  Values(std::string_view arguments, const uint8_t* values, size_t bytes)
      : arguments_(arguments), values_(values), bytes_(bytes) {}

  std::string next(const shader::PrintConversion& conversion) {
    if (arguments_.size() < 3) return {};
    const char type = arguments_[0];
    const int rows = arguments_[1] - '0';
    const int columns = arguments_[2] - '0';
    arguments_.remove_prefix(3);
    std::string out = rows > 1 ? "(" : "";
    for (int r = 0; r < rows; ++r) {
      if (r != 0) out += ", ";
      if (columns > 1) out += "(";
      for (int c = 0; c < columns; ++c) {
        out += (c == 0 ? "" : ", ") + number_text(conversion, number(type));
      }
      if (columns > 1) out += ")";
    }
    return rows > 1 ? out + ")" : out;
  }

 private:
  Number number(char type) {
    Number out = {type, 0};
    const size_t size = out.is_wide() ? 8 : 4;
    if (bytes_ >= size) std::memcpy(&out.bits, values_, size);
    values_ += std::min(size, bytes_);
    bytes_ -= std::min(size, bytes_);
    return out;
  }

  std::string_view arguments_;
  const uint8_t* values_;
  size_t bytes_;
};

struct Record {
  uint32_t thread[3];
  const uint8_t* begin;
  uint32_t bytes;
};

std::vector<Record> sorted_records(const uint8_t* bytes, uint32_t end) {
  std::vector<Record> records;
  for (uint32_t at = shader::kPrintRecords; at + shader::kRecordValues <= end;) {
    Record record = {{}, bytes + at, word_at(bytes + at, shader::kRecordBytes)};
    if (record.bytes < shader::kRecordValues || record.bytes > end - at) break;
    std::memcpy(record.thread, record.begin + shader::kRecordThread, sizeof record.thread);
    records.push_back(record);
    at += record.bytes;
  }
  std::stable_sort(records.begin(), records.end(), [](const Record& a, const Record& b) {
    return std::tie(a.thread[2], a.thread[1], a.thread[0]) <
           std::tie(b.thread[2], b.thread[1], b.thread[0]);
  });
  return records;
}

void add_library(const LinkedShader& shader, PrintingLibraries& out) {
  const shader::LibraryDesc* library = shader.library;
  if (library == nullptr || library->print_count == 0) return;
  if (std::find(out.begin(), out.end(), library) == out.end()) out.push_back(library);
}

}  // namespace

shader::Descriptor view_of_prints(const RootBindings& state) {
  shader::Descriptor view;
  if (state.prints == nullptr) return view;
  view.kind = shader::DescriptorKind::kRawBuffer;
  view.access = shader::DescriptorAccess::kUnorderedAccess;
  view.address = state.prints->address();
  view.size_bytes = state.prints->size_bytes();
  return view;
}

void clear_prints(BackendBuffer& buffer, const std::optional<std::array<uint32_t, 3>>& thread) {
  uint8_t* bytes = buffer.host();
  std::memset(bytes, 0, shader::kPrintRecords);
  set_word(bytes, shader::kPrintRoom,
           static_cast<uint32_t>(buffer.size_bytes()) - shader::kPrintRecords);
  if (!thread) return;
  set_word(bytes, shader::kPrintFilter, 1);
  std::memcpy(bytes + shader::kPrintThread, thread->data(), sizeof *thread);
}

PrintingLibraries printing_libraries(const LinkedPipeline& pipeline) {
  PrintingLibraries out;
  for (const auto& shader : pipeline.shaders) add_library(*shader, out);
  return out;
}
PrintingLibraries printing_libraries(const LinkedCompute& pipeline) {
  PrintingLibraries out;
  add_library(pipeline.shader, out);
  return out;
}
PrintingLibraries printing_libraries(const LinkedGraphics& pipeline) {
  PrintingLibraries out;
  for (const LinkedShader* shader : pipeline.shaders()) add_library(*shader, out);
  return out;
}

Printed printed_by(const Command& command) {
  Printed out;
  const auto take = [&](const RootBindings& state, const auto& linked) {
    if (state.prints == nullptr || linked == nullptr) return;
    out.libraries = printing_libraries(*linked);
    if (!out.libraries.empty()) out.buffer = state.prints.get();
  };
  if (const auto* rays = std::get_if<DispatchRaysCommand>(&command)) {
    take(rays->state, rays->linked);
  } else if (const auto* compute = std::get_if<DispatchCommand>(&command)) {
    take(compute->state, compute->linked);
  } else if (const auto* draw = std::get_if<DrawCommand>(&command)) {
    take(draw->bindings, draw->linked);
  }
  return out;
}

std::string print_text(const shader::PrintDesc& print, const uint8_t* values, size_t bytes) {
  const std::string_view format = print.format;
  Values next(print.arguments, values, bytes);
  std::string out;
  size_t at = 0;
  while (const auto conversion = shader::next_conversion(format, at)) {
    out += format.substr(at, conversion->begin - at);
    at = conversion->end;
    out += conversion->letter == '%' ? "%" : next.next(*conversion);
  }
  out += format.substr(at);
  if (out.ends_with('\n')) out.pop_back();
  return out;
}

void tell_prints(const Printed& printed, const std::string& label,
                 const std::function<void(const rtapi::Message&)>& tell) {
  BackendBuffer& buffer = *printed.buffer;
  uint8_t* bytes = buffer.host();
  const uint32_t used = word_at(bytes, shader::kPrintUsed);
  if (used == 0) return;
  std::unordered_map<uint64_t, const shader::PrintDesc*> prints;
  for (const shader::LibraryDesc* library : printed.libraries) {
    for (uint32_t i = 0; i < library->print_count; ++i) {
      prints.emplace(library->prints[i].id, &library->prints[i]);
    }
  }
  const auto end = static_cast<uint32_t>(
      std::min<uint64_t>(buffer.size_bytes(), uint64_t{shader::kPrintRecords} + used));
  const std::vector<Record> records = sorted_records(bytes, end);
  uint64_t taken = 0;
  for (const Record& record : records) {
    taken += record.bytes;
    uint64_t id;
    std::memcpy(&id, record.begin + shader::kRecordId, sizeof id);
    const auto print = prints.find(id);
    if (print == prints.end()) continue;
    const std::string thread = "(" + std::to_string(record.thread[0]) + "," +
                               std::to_string(record.thread[1]) + "," +
                               std::to_string(record.thread[2]) + ")";
    tell(make_message(print->second->is_error ? Id::kShaderError : Id::kShaderPrint,
                      thread + ": " +
                          print_text(*print->second, record.begin + shader::kRecordValues,
                                     record.bytes - shader::kRecordValues)));
  }
  const uint32_t lost = word_at(bytes, shader::kPrintLost);
  if (lost != 0 || taken < used) {
    tell(make_message(Id::kPrintsLost,
                      "the print buffer takes " + std::to_string(buffer.size_bytes()) +
                          " bytes, and " + std::to_string(lost + (taken < used ? 1u : 0u)) +
                          " calls or more found no room (" + label + "). Print in fewer threads"));
  }
  set_word(bytes, shader::kPrintUsed, 0);
  set_word(bytes, shader::kPrintLost, 0);
  std::memset(bytes + shader::kPrintRecords, 0, end - shader::kPrintRecords);
}

}  // namespace kaamos::runtime
