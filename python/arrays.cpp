// SPDX-License-Identifier: MIT
#include "python/arrays.h"

#include <cstring>
#include <utility>

namespace kaamos::python {

using rtapi::Format;

py::array contiguous(const py::object& object) {
  const py::array array = py::array::ensure(object, py::array::c_style);
  if (!array) throw py::error_already_set();
  return array;
}

std::span<const std::byte> bytes_of(const py::array& array) {
  return {static_cast<const std::byte*>(array.data()), static_cast<size_t>(array.nbytes())};
}

namespace {

// The shape, with the axis of -1 filled from the number of bytes.
std::vector<py::ssize_t> full_shape(std::vector<py::ssize_t> shape, const py::dtype& type,
                                    uint64_t bytes) {
  py::ssize_t count = 1;
  py::ssize_t free_axis = -1;
  for (size_t i = 0; i < shape.size(); ++i) {
    if (shape[i] < 0) {
      free_axis = static_cast<py::ssize_t>(i);
    } else {
      count *= shape[i];
    }
  }
  const auto items = static_cast<py::ssize_t>(bytes) / type.itemsize();
  if (free_axis >= 0) {
    shape[static_cast<size_t>(free_axis)] = count == 0 ? 0 : items / count;
    count *= shape[static_cast<size_t>(free_axis)];
  }
  if (count > items) {
    throw py::value_error("the array would have " + std::to_string(count * type.itemsize()) +
                          " bytes, and there are " + std::to_string(bytes));
  }
  return shape;
}

}  // namespace

py::array array_of(const std::vector<std::byte>& bytes, const py::dtype& type,
                   std::vector<py::ssize_t> shape) {
  py::array out(type, full_shape(std::move(shape), type, bytes.size()));
  std::memcpy(out.mutable_data(), bytes.data(), static_cast<size_t>(out.nbytes()));
  return out;
}

py::array mapped_array(const rtapi::Buffer& buffer, const py::dtype& type,
                       std::vector<py::ssize_t> shape) {
  const std::span<std::byte> bytes = buffer.Map().value();
  const py::capsule keeps(new rtapi::Buffer(buffer),
                          [](void* held) { delete static_cast<rtapi::Buffer*>(held); });
  return py::array(type, full_shape(std::move(shape), type, bytes.size()), bytes.data(), keeps);
}

Format format_of(const py::dtype& type, py::ssize_t channels) {
  struct Row {
    char kind;
    py::ssize_t size;
    Format formats[4];  // by channels
  };
  constexpr Row kRows[] = {
      {'f',
       4,
       {Format::kR32Float, Format::kR32G32Float, Format::kUnknown, Format::kR32G32B32A32Float}},
      {'f',
       2,
       {Format::kR16Float, Format::kR16G16Float, Format::kUnknown, Format::kR16G16B16A16Float}},
      {'u', 1, {Format::kR8Unorm, Format::kR8G8Unorm, Format::kUnknown, Format::kR8G8B8A8Unorm}},
      {'u',
       4,
       {Format::kR32Uint, Format::kR32G32Uint, Format::kUnknown, Format::kR32G32B32A32Uint}},
      {'i',
       4,
       {Format::kR32Sint, Format::kR32G32Sint, Format::kUnknown, Format::kR32G32B32A32Sint}},
  };
  for (const Row& row : kRows) {
    if (type.kind() != row.kind || type.itemsize() != row.size) continue;
    if (channels >= 1 && channels <= 4 && row.formats[channels - 1] != Format::kUnknown) {
      return row.formats[channels - 1];
    }
  }
  throw py::type_error("no texture or typed buffer has " + std::to_string(channels) +
                       " channels of '" +
                       static_cast<std::string>(py::str(static_cast<py::handle>(type))) +
                       "': there are 1, 2 and 4 of float32, float16, uint8 (as 0 to 1), uint32 and "
                       "int32");
}

}  // namespace kaamos::python
