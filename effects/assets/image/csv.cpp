// SPDX-License-Identifier: MIT
#include "effects/assets/image/csv.h"

#include <cstdio>

namespace kaamos::effects {
namespace {

void add_line(const std::vector<std::string>& cells, std::string& out) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += ',';
    if (cells[i].find_first_of(",\"\r\n") == std::string::npos) {
      out += cells[i];
      continue;
    }
    out += '"';
    for (const char c : cells[i]) {
      if (c == '"') out += '"';
      out += c;
    }
    out += '"';
  }
  out += '\n';
}

// Takes one row from the text; a quoted cell may span several lines. Returns false if a quote is
// not closed.
bool take_line(std::string_view& text, std::vector<std::string>& cells) {
  cells.assign(1, "");
  bool quoted = false;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        cells.back() += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cells.back() += '"';
        ++i;
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      ++i;
      break;
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  text.remove_prefix(i);
  return !quoted;
}

}  // namespace

std::string write_csv(const Table& table) {
  std::string out;
  add_line(table.columns, out);
  for (const auto& row : table.rows) add_line(row, out);
  return out;
}

Result<Table> parse_csv(std::string_view text) {
  if (text.empty())
    return make_error(ErrorId::kCsv, "the table is empty: a line of column names is missing");
  Table table;
  std::vector<std::string> cells;
  for (std::size_t line = 1; !text.empty(); ++line) {
    if (!take_line(text, cells)) {
      return make_error(ErrorId::kCsv, "row " + std::to_string(line) + ": a quote is not closed");
    }
    if (line == 1) {
      table.columns = cells;
      continue;
    }
    if (cells.size() != table.columns.size()) {
      return make_error(ErrorId::kCsv,
                        "row " + std::to_string(line) + " has " + std::to_string(cells.size()) +
                            " cells, the first one has " + std::to_string(table.columns.size()));
    }
    table.rows.push_back(cells);
  }
  return table;
}

std::string csv_number(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace kaamos::effects
