// SPDX-License-Identifier: MIT
//
// The format is a marker, then length-prefixed strings in a fixed order.
#include "runtime/hlsl/driver/embedded_source.h"

#include <charconv>

namespace kaamos::hlsl {
namespace {

constexpr std::string_view kMark = "kaamos source 1\n";

class Writer {
 public:
  void add(std::string_view text) {
    out_ += std::to_string(text.size());
    out_ += ':';
    out_ += text;
  }
  void add(uint64_t number) { add(std::to_string(number)); }
  void add(const std::vector<std::string>& list) {
    add(list.size());
    for (const std::string& item : list) add(std::string_view(item));
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_{kMark};
};

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {
    ok_ = rest_.starts_with(kMark);
    if (ok_) rest_.remove_prefix(kMark.size());
  }
  std::string text() {
    size_t size = 0;
    const char* end = rest_.data() + rest_.size();
    const auto [behind, error] = std::from_chars(rest_.data(), end, size);
    ok_ = ok_ && error == std::errc() && behind != end && *behind == ':';
    if (ok_) rest_.remove_prefix(static_cast<size_t>(behind - rest_.data()) + 1);
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) return {};
    const std::string out(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return out;
  }
  uint32_t number() {
    const std::string digits = text();
    uint32_t out = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), out);
    return out;
  }
  std::vector<std::string> list() {
    std::vector<std::string> out;
    for (uint32_t left = number(); left > 0 && ok_; --left) out.push_back(text());
    return out;
  }
  bool ok() const { return ok_; }

 private:
  std::string_view rest_;
  bool ok_ = false;
};

}  // namespace

std::string embed_source(const FrontendOptions& options, const SourceManager& sources) {
  Writer out;
  out.add(std::string_view(options.path));
  out.add(options.text ? 1u : 0u);
  out.add(std::string_view(options.text ? *options.text : ""));
  out.add(options.include_folders);
  out.add(options.defines);
  out.add(std::string_view(options.target));
  out.add(std::string_view(options.entry_point));
  out.add(std::string_view(options.exports));
  for (const uint32_t number :
       {uint32_t{options.external_linkage}, options.automatic_space, options.hlsl_version,
        uint32_t{options.native_16bit}, uint32_t{options.row_major}, uint32_t{options.strict},
        uint32_t{options.reserve_unused}}) {
    out.add(number);
  }
  out.add(options.payload_qualifiers ? 1u + (*options.payload_qualifiers ? 1u : 0u) : 0u);
  const auto files = sources.loaded_files();
  out.add(files.size());
  for (const auto& [path, text] : files) {
    out.add(std::string_view(path));
    out.add(std::string_view(text->text));
  }
  return out.take();
}

std::optional<EmbeddedSource> read_embedded_source(std::string_view text) {
  Reader in(text);
  EmbeddedSource out;
  FrontendOptions& options = out.options;
  options.path = in.text();
  const bool has_text = in.number() != 0;
  const std::string main = in.text();
  if (has_text) options.text = main;
  options.include_folders = in.list();
  options.defines = in.list();
  options.target = in.text();
  options.entry_point = in.text();
  options.exports = in.text();
  options.external_linkage = in.number() != 0;
  options.automatic_space = in.number();
  options.hlsl_version = in.number();
  options.native_16bit = in.number() != 0;
  options.row_major = in.number() != 0;
  options.strict = in.number() != 0;
  options.reserve_unused = in.number() != 0;
  if (const uint32_t given = in.number()) options.payload_qualifiers = given == 2;
  options.experimental = true;  // what was allowed when the library was made
  for (uint32_t left = in.number(); left > 0 && in.ok(); --left) {
    std::string path = normalize_path(in.text());
    out.files.add(std::move(path), in.text());
  }
  if (!in.ok()) return std::nullopt;
  return out;
}

}  // namespace kaamos::hlsl
