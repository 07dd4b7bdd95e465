// SPDX-License-Identifier: MIT
//
// numpy arrays as buffers and textures, and back.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <rtapi/rtapi.h>

#include <string>
#include <vector>

namespace kaamos::python {

namespace py = pybind11;

// A buffer, and the array that it was made from: what numpy() gives without arguments. On a custom
// heap it is the memory of an array, too.
struct ArrayBuffer {
  rtapi::Buffer buffer;
  py::dtype type;
  std::vector<py::ssize_t> shape;
};

// A 2-D texture of one mip, whose texels are those of an array of shape (height, width) or (height,
// width, channels).
struct ArrayTexture {
  rtapi::Texture texture;
  py::dtype type;
  std::vector<py::ssize_t> shape;
};

// C-contiguous; a copy if it is not already.
py::array contiguous(const py::object& object);
std::span<const std::byte> bytes_of(const py::array& array);
py::array array_of(const std::vector<std::byte>& bytes, const py::dtype& type,
                   std::vector<py::ssize_t> shape);
// The mapped bytes of a buffer, without a copy. The array keeps the buffer.
py::array mapped_array(const rtapi::Buffer& buffer, const py::dtype& type,
                       std::vector<py::ssize_t> shape);

// The format whose texels an array's last axis has. Throws py::type_error for others.
rtapi::Format format_of(const py::dtype& type, py::ssize_t channels);

}  // namespace kaamos::python
