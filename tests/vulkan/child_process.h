// SPDX-License-Identifier: MIT
//
// A program that is started, waited for, and stopped after its limit.
#pragma once

#include <string>

namespace kaamos::test {

double now_seconds();

// `command` ends with a null. Its output goes to `output` if that names a file. Returns waitpid's
// status, or -1 if the program had to be stopped.
int run(char** command, double limit_seconds, const std::string& output = "");

// Returns whether a signal or the limit ended a program.
bool crashed(int status);
std::string describe(int status, double limit_seconds);

}  // namespace kaamos::test
