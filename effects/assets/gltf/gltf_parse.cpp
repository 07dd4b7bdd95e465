// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_parse.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/assets/gltf/gltf_document.h"

namespace kaamos::effects {
namespace {

/// The depth to which arrays and objects may nest: far deeper than glTF needs, and shallow enough
/// for the parser, which recurses over extensions.
constexpr int kMaxJsonDepth = 128;

/// Keeps the encoded bytes of images that come by URI, and decodes nothing. It does not touch
/// images in buffer views, because their pointer is not checked against the buffer.
bool keep_encoded(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void* user) {
  auto& kept = *static_cast<std::vector<std::vector<std::uint8_t>>*>(user);
  if (index < 0) return false;
  if (kept.size() <= static_cast<std::size_t>(index))
    kept.resize(static_cast<std::size_t>(index) + 1);
  if (image->bufferView < 0 && size > 0)
    kept[static_cast<std::size_t>(index)].assign(bytes, bytes + size);
  return true;
}

/// A log of the files that a scene names, because the parser's words about them are its own.
struct FileLog {
  std::string trouble;    // why one could not be read
  std::string last_read;  // what was read of the last one
  // What the parser asks for first are the buffers, in their order, and it takes none that is
  // longer than it says.
  std::vector<std::size_t> lengths;
  std::size_t next = 0;
};

/// Reads a file that a scene names as any other file is read: the parser's own reader asks a folder
/// for its size and then for that much memory.
bool read_named_file(std::vector<unsigned char>* out, std::string*, const std::string& path,
                     void* user) {
  Result<std::vector<std::uint8_t>> bytes = read_file(path);
  auto& log = *static_cast<FileLog*>(user);
  if (bytes.ok()) {
    log.last_read = "\"" + path + "\" has " + std::to_string(bytes.value().size()) +
                    " bytes, its byteLength says another number";
    *out = std::move(bytes.value());
    if (log.next < log.lengths.size() && out->size() > log.lengths[log.next])
      out->resize(log.lengths[log.next]);
    ++log.next;
  } else {
    log.trouble = bytes.error().message;
  }
  return bytes.ok();
}

bool named_file_exists(const std::string& path, void* user) {
  const bool exists = tinygltf::FileExists(path, nullptr);
  static_cast<FileLog*>(user)->trouble =
      exists ? "" : "cannot read \"" + path + "\": there is no such file";
  return exists;
}

/// The parser's files, read by read_named_file. Later versions of it have one more callback.
template <class Callbacks>
Callbacks file_callbacks(FileLog& log) {
  Callbacks files = {};
  files.FileExists = &named_file_exists;
  files.ExpandFilePath = &tinygltf::ExpandFilePath;
  files.ReadWholeFile = &read_named_file;
  files.WriteWholeFile = &tinygltf::WriteWholeFile;
  files.user_data = &log;
  if constexpr (requires { files.GetFileSizeInBytes; }) {
    files.GetFileSizeInBytes = [](std::size_t* size, std::string* error, const std::string& path,
                                  void* user) {
      std::vector<unsigned char> bytes;
      FileLog other;  // this is not the read that counts
      const bool is_read = read_named_file(&bytes, error, path, &other);
      if (!is_read) static_cast<FileLog*>(user)->trouble = other.trouble;
      *size = bytes.size();
      return is_read;
    };
  }
  return files;
}

/// True if no array or object is nested deeper than kMaxJsonDepth.
bool shallow(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxJsonDepth) return false;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return true;
}

/// The parts of a file.
struct Chunks {
  std::string_view json;
  std::optional<std::string_view> binary;  // the second chunk of a .glb
};

constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkHeader = 8;

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

Error is_cut(const std::string& what, std::size_t needed, std::size_t has) {
  return make_error(ErrorId::kGltf, "is cut: " + what + " " + std::to_string(needed) +
                                        " bytes, the file has " + std::to_string(has));
}

Result<Chunks> glb_chunks(std::string_view bytes) {
  constexpr std::size_t kLeast = kGlbHeader + kChunkHeader;
  if (bytes.size() < kLeast) return is_cut("a .glb has at least", kLeast, bytes.size());
  if (word_at(bytes, 4) != 2)
    return make_error(ErrorId::kGltf, "is a .glb of version " + std::to_string(word_at(bytes, 4)) +
                                          ", version 2 is supported");
  if (word_at(bytes, 8) > bytes.size())
    return is_cut("its header says", word_at(bytes, 8), bytes.size());
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  if (word_at(bytes, kGlbHeader + 4) != kJson)
    return make_error(ErrorId::kGltf, "its first chunk is not JSON");
  const std::size_t size = word_at(bytes, kGlbHeader);
  if (size > bytes.size() - kLeast) return is_cut("its JSON needs", size, bytes.size() - kLeast);
  Chunks out;
  out.json = bytes.substr(kLeast, size);
  const std::size_t second = kLeast + size;
  if (bytes.size() - second < kChunkHeader || word_at(bytes, second + 4) != kBinary) return out;
  const std::size_t binary = word_at(bytes, second);
  if (binary > bytes.size() - second - kChunkHeader)
    return is_cut("its binary chunk needs", binary, bytes.size() - second - kChunkHeader);
  out.binary = bytes.substr(second + kChunkHeader, binary);
  return out;
}

Result<Chunks> chunks_of(std::string_view bytes) {
  if (bytes.starts_with("glTF")) return glb_chunks(bytes);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string_view::npos || bytes[first] != '{')
    return make_error(ErrorId::kGltf, "is neither a .gltf (JSON) nor a .glb file");
  return Chunks{bytes, std::nullopt};
}

/// A .glb of these chunks. tinygltf 2.7 forgets the 8 bytes of the chunk header when it checks the
/// binary chunk, so it reads that far past the end of a truncated file: 16 bytes of padding, which
/// the size in its header does not count, keep the read inside.
std::vector<std::uint8_t> glb_of(std::string json, std::optional<std::string_view> binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string_view data = binary.value_or("");
  const std::size_t data_bytes = (data.size() + 3) / 4 * 4;
  std::vector<std::uint8_t> out;
  out.reserve(kGlbHeader + 2 * kChunkHeader + json.size() + data_bytes + 16);
  const auto word = [&](std::size_t value) {
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  out.insert(out.end(), {'g', 'l', 'T', 'F'});
  word(2);
  word(kGlbHeader + kChunkHeader + json.size() + (binary ? kChunkHeader + data_bytes : 0));
  word(json.size());
  word(0x4E4F534A);
  out.insert(out.end(), json.begin(), json.end());
  if (binary) {
    word(data_bytes);
    word(0x004E4942);
    out.insert(out.end(), data.begin(), data.end());
    out.resize(out.size() + data_bytes - data.size(), 0);
  }
  out.resize(out.size() + 16, 0);
  return out;
}

}  // namespace

Status parse_gltf(std::span<const std::uint8_t> bytes, const std::string& folder,
                  tinygltf::Model& model, std::vector<std::vector<std::uint8_t>>& images,
                  std::vector<std::string>& warnings) {
  if (bytes.size() > 0xFFFFFF00u) return make_error(ErrorId::kGltf, "is larger than 4 GB");
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const Result<Chunks> chunks = chunks_of(all);
  if (!chunks.ok()) return chunks.error();
  const auto [json, binary] = chunks.value();
  if (!shallow(json))
    return make_error(ErrorId::kGltf, "its JSON is nested deeper than " +
                                          std::to_string(kMaxJsonDepth) + " levels");
  const Result<GltfDocument> document =
      check_gltf_document(json, binary ? std::optional(binary->size()) : std::nullopt, warnings);
  if (!document.ok()) return document.error();

  FileLog files;
  files.lengths = document.value().named_bytes;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, &images);
  loader.SetFsCallbacks(file_callbacks<tinygltf::FsCallbacks>(files));
  // The parser's own words name neither the part of the file nor what is allowed.
  std::string error, warning;
  bool parsed = false;
  const std::string_view text =
      document.value().json ? std::string_view(*document.value().json) : json;
  try {
    if (all.starts_with("glTF")) {
      const std::vector<std::uint8_t> glb = glb_of(std::string(text), binary);
      parsed = loader.LoadBinaryFromMemory(&model, &error, &warning, glb.data(),
                                           static_cast<unsigned int>(glb.size() - 16), folder);
    } else {
      parsed = loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                          static_cast<unsigned int>(text.size()), folder);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // a member has another type than the parser expects
    parsed = false;
  }
  if (!parsed) {
    const bool other_size = error.find("mismatch") != std::string::npos;
    return make_error(ErrorId::kGltf, !files.trouble.empty()                   ? files.trouble
                                      : other_size && !files.last_read.empty() ? files.last_read
                                                                               : kGltfRefused);
  }
  for (const HiddenIndices& hidden : document.value().hidden)
    model.meshes[hidden.mesh].primitives[hidden.primitive].indices = hidden.accessor;
  images.resize(model.images.size());
  if (const Status status = decode_meshopt(model, document.value().meshopt); !status.ok())
    return status;
  return decode_draco(model, document.value().draco, warnings);
}

}  // namespace kaamos::effects
