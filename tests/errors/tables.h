// SPDX-License-Identifier: MIT
//
// The error tables of every layer as one list, what must hold for them, and what is made of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kaamos::errors {

struct Row {
  int number;                 // in KAnnnn
  std::string_view name;      // the enumerator: "kUpdate"
  std::string_view severity;  // "kError", "kWarning", "kInfo" or the compiler's "kStrict"
  std::string_view code;      // an enumerator of rtapi::ErrorCode
  std::string_view meaning;   // the title or the text of the message
  std::string_view rule;      // an item of the conformance list or a D3D12 topic; may be empty
  std::string_view cure;
};

struct Range {
  int first;
  int last;
};

struct Layer {
  std::string_view title;
  std::string_view about;       // a paragraph
  std::vector<Range> ranges;    // which ids the layer may use
  bool has_codes;               // whether its errors are rtapi::Error
  std::string_view namespace_;  // in <rtapi/error_ids.h>; empty: its ids are not there
  std::vector<Row> rows;        // sorted by number
};

// "KA0712"
std::string id_text(int number);

const std::vector<Layer>& all_layers();

// One line for each fault: ids that occur twice, in the wrong order or outside their layer's
// ranges; rows without a meaning or without a cure that is a sentence; names that occur twice in a
// namespace.
std::vector<std::string> faults_of(const std::vector<Layer>& layers);

// rtapi/ERRORS.md
std::string markdown(const std::vector<Layer>& layers);

// rtapi/include/rtapi/error_ids.h
std::string header(const std::vector<Layer>& layers);

}  // namespace kaamos::errors
