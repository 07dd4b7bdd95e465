// SPDX-License-Identifier: MIT
//
// The error tables of every layer as one list, what must hold for them, and the page made of them.
#pragma once

#include <string>
#include <vector>

namespace kaamos::errors {

struct Row {
  int number;  // in KAnnnn
  std::string severity;
  std::string code;     // ErrorCode; empty where the layer reports no rtapi::Error
  std::string meaning;  // the title or the text of the message
  std::string rule;     // an item of the conformance list or a D3D12 topic; may be empty
  std::string cure;
};

struct Range {
  int first;
  int last;
};

struct Layer {
  std::string title;
  std::string about;          // a paragraph
  std::vector<Range> ranges;  // which ids the layer may use
  std::vector<Row> rows;      // sorted by number
};

// "KA0712"
std::string id_text(int number);

const std::vector<Layer>& all_layers();

// One line for each fault: ids that occur twice, in the wrong order or outside their layer's
// ranges; rows without a meaning or without a cure that is a sentence.
std::vector<std::string> faults_of(const std::vector<Layer>& layers);

// rtapi/ERRORS.md
std::string markdown(const std::vector<Layer>& layers);

}  // namespace kaamos::errors
