// SPDX-License-Identifier: MIT
//
// Damaged HLSL: sources with tokens and bytes removed, duplicated, swapped and mixed.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace kaamos::test {

struct CorpusFile {
  std::string path;
  std::vector<std::string> pieces;  // tokens and the space between them; joined, they give the file
};

struct Corpus {
  std::vector<CorpusFile> files;             // the .hlsl files to mutate
  std::vector<std::string> tokens;           // the tokens of all files, as often as they occur
  std::map<std::string, std::string> texts;  // every .hlsl and .hlsli by its path, for #include
};

// Reads every .hlsl and .hlsli file below these folders, ordered by path.
Corpus read_corpus(const std::vector<std::string>& folders);

struct Input {
  std::string path;  // path of the original file, so that its #includes are found
  std::string text;
};

// Deterministic for a given corpus, seed and number.
Input mutated_input(const Corpus& corpus, uint64_t seed, uint64_t number);

}  // namespace kaamos::test
