// SPDX-License-Identifier: MIT
//
// Damaged HLSL: sources with tokens and bytes removed, doubled, exchanged and mixed.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace kaamos::test {

struct CorpusFile {
  std::string path;
  std::vector<std::string> pieces;  // tokens and the space between them; joined they are the file
};

struct Corpus {
  std::vector<CorpusFile> files;             // .hlsl, what is mutated
  std::vector<std::string> tokens;           // all of all files, as often as they occur
  std::map<std::string, std::string> texts;  // every .hlsl and .hlsli by its path, for #include
};

// Every .hlsl and .hlsli file below these folders, in the order of their paths.
Corpus read_corpus(const std::vector<std::string>& folders);

struct Input {
  std::string path;  // of the file it was made from, so that its #includes are found
  std::string text;
};

// The same for the same corpus, seed and number.
Input mutated_input(const Corpus& corpus, uint64_t seed, uint64_t number);

}  // namespace kaamos::test
