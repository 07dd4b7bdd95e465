// SPDX-License-Identifier: MIT
/// @file
/// Tables as comma-separated values. [RFC 4180]
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

/// A table of text.
struct Table {
  std::vector<std::string> columns;            ///< their names
  std::vector<std::vector<std::string>> rows;  ///< as many cells as there are columns
};

/// A line for the columns and for each row; cells are quoted where they must be.
std::string write_csv(const Table& table);

/// @errors KA3003 no line at all, a row of another length (with its line), a quote that is not
/// closed.
Result<Table> parse_csv(std::string_view text);

/// A number with `digits` significant ones; "inf", "-inf" and "nan" too.
std::string csv_number(double value, int digits = 6);

}  // namespace kaamos::effects
