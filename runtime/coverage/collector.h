// SPDX-License-Identifier: MIT
//
// What the shaders of this process ran, for the tracefile that $KAAMOS_COVERAGE names.
#pragma once

#include <memory>
#include <string>

#include <kaamos/shader/abi.h>
#include <kaamos/shader/coverage.h>

namespace kaamos::coverage {

// Returns whether $KAAMOS_COVERAGE names a file. Libraries are compiled with coverage then.
bool is_asked();

// Tries whether the file can be written, once in a process. Returns what is wrong with it; empty:
// nothing, or nothing is asked for.
std::string begin();

// Collects what a library runs from now on, until the last copy of the result is gone, which keeps
// `owner` alive. What ran is written when a device ends and when the process does.
std::shared_ptr<const void> collect(const shader::LibraryDesc& library,
                                    const shader::CoverageDesc& table,
                                    std::shared_ptr<const void> owner);

// The table of a library that is collected; null: it has none.
const shader::CoverageDesc* table_of(const shader::LibraryDesc& library);

// Adds to the file what it does not have yet: a run counts once for each line and arm, however
// often it came there. Returns what went wrong; empty: nothing.
std::string write();

// One whose shaders cannot write into CoverageDesc::ran.
class Reader {
 public:
  virtual ~Reader() = default;
  // Brings `table.ran` up to date. `is_last`: the library ends, and may not be used afterwards.
  virtual void read(const shader::CoverageDesc& table, bool is_last) = 0;
};
// A reader must not add or remove one while it is called.
void add_reader(Reader& reader);
void remove_reader(Reader& reader);

}  // namespace kaamos::coverage
