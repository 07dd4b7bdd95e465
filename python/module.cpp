// SPDX-License-Identifier: MIT
//
// The extension module kaamos._kaamos. kaamos/__init__.py says what each thing is for.
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <rtapi/upload.h>
#include <rtapi/version.h>

#include "python/draws.h"
#include "python/frame.h"
#include "python/rays.h"

namespace kaamos::python {
namespace {

Library compile(const Session& session, const std::string& source, const std::string& file,
                const std::string& target, const std::vector<std::string>& include,
                const std::map<std::string, std::string>& define) {
  rtapi::ShaderCompileOptions options;
  options.File = file;
  if (!source.empty()) options.Source = source;
  options.Target = target;
  options.Experimental = target.ends_with("_10");
  options.IncludeDirectories = include;
  for (const auto& [name, value] : define) options.Defines.push_back({name, value});
  return session.compile(std::move(options));
}

std::vector<py::ssize_t> shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

ArrayBuffer make_buffer(Session& session, const py::object& object) {
  const py::array array = contiguous(object);
  if (array.nbytes() == 0) throw py::value_error("the array is empty");
  return {rtapi::CreateDefaultBuffer(session.device(), session.queue(), bytes_of(array),
                                     rtapi::ResourceFlags::kAllowUnorderedAccess, "buffer")
              .value(),
          array.dtype(), shape_of(array)};
}

// A buffer whose memory is that of an array.
ArrayBuffer make_mapped_buffer(Session& session, const py::object& object) {
  const py::array array = contiguous(object);
  if (array.nbytes() == 0) throw py::value_error("the array is empty");
  const std::span<const std::byte> bytes = bytes_of(array);
  const rtapi::Buffer buffer =
      session.device()
          .CreateBuffer({.SizeInBytes = bytes.size(),
                         .Heap = rtapi::HeapType::kCustom,
                         .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess,
                         .Name = "mapped buffer"})
          .value();
  std::copy(bytes.begin(), bytes.end(), buffer.Map().value().begin());
  return {buffer, array.dtype(), shape_of(array)};
}

// What the device copied is the array's memory.
py::array read_buffer(Session& session, const ArrayBuffer& from, const py::object& type,
                      const py::object& shape) {
  const rtapi::Buffer copy = session.device()
                                 .CreateBuffer({.SizeInBytes = from.buffer.size(),
                                                .Heap = rtapi::HeapType::kReadback,
                                                .Name = "readback"})
                                 .value();
  rtapi::CommandList list = session.device().CreateCommandList().value();
  list.CopyBufferRegion(copy, 0, from.buffer, 0, copy.size());
  session.execute(list, {});
  const bool as_made = type.is_none() && shape.is_none();
  const py::dtype chosen = type.is_none() ? from.type : py::dtype::from_args(type);
  return mapped_array(copy, chosen,
                      !shape.is_none() ? shape.cast<std::vector<py::ssize_t>>()
                      : as_made        ? from.shape
                                       : std::vector<py::ssize_t>{-1});
}

ArrayTexture make_texture(Session& session, const py::object& object) {
  const py::array array = contiguous(object);
  if (array.ndim() != 2 && array.ndim() != 3) {
    throw py::type_error("a texture has the shape (height, width) or (height, width, channels)");
  }
  rtapi::TextureDesc desc;
  desc.Height = static_cast<uint32_t>(array.shape(0));
  desc.Width = static_cast<uint32_t>(array.shape(1));
  desc.Format = format_of(array.dtype(), array.ndim() == 3 ? array.shape(2) : 1);
  desc.Flags =
      rtapi::ResourceFlags::kAllowUnorderedAccess | rtapi::ResourceFlags::kAllowRenderTarget;
  desc.Name = "texture";
  const rtapi::Texture texture = session.device().CreateTexture(desc).value();
  rtapi::UploadTexture(session.device(), session.queue(), texture, 0, bytes_of(array)).value();
  return {texture, array.dtype(), shape_of(array)};
}

py::array read_texture(const Session& session, const ArrayTexture& from) {
  std::vector<std::byte> bytes;
  {
    const py::gil_scoped_release released;
    bytes = rtapi::ReadbackTexture(session.device(), session.queue(), from.texture, 0).value();
  }
  return array_of(bytes, from.type, from.shape);
}

template <class Value>
Value named(const std::map<std::string, Value>& names, const std::string& name, const char* what) {
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  std::string all;
  for (const auto& [one, value] : names) all += (all.empty() ? "'" : ", '") + one + "'";
  throw py::value_error(std::string(what) + " is '" + name + "'; there are " + all);
}

rtapi::SamplerDesc sampler_desc(const std::string& filter, const std::string& address,
                                const std::string& compare, std::array<float, 4> border, float bias,
                                std::array<float, 2> lod) {
  using rtapi::ComparisonFunc;
  using rtapi::Filter;
  using rtapi::TextureAddressMode;
  static const std::map<std::string, Filter> kFilters = {{"nearest", Filter::kMinMagMipPoint},
                                                         {"linear", Filter::kMinMagMipLinear},
                                                         {"anisotropic", Filter::kAnisotropic}};
  static const std::map<std::string, TextureAddressMode> kAddresses = {
      {"wrap", TextureAddressMode::kWrap},
      {"mirror", TextureAddressMode::kMirror},
      {"clamp", TextureAddressMode::kClamp},
      {"border", TextureAddressMode::kBorder},
      {"mirror once", TextureAddressMode::kMirrorOnce}};
  static const std::map<std::string, ComparisonFunc> kComparisons = {
      {"less", ComparisonFunc::kLess},
      {"equal", ComparisonFunc::kEqual},
      {"less equal", ComparisonFunc::kLessEqual},
      {"greater", ComparisonFunc::kGreater},
      {"not equal", ComparisonFunc::kNotEqual},
      {"greater equal", ComparisonFunc::kGreaterEqual},
      {"always", ComparisonFunc::kAlways}};
  constexpr uint32_t kCompares = 0x80;  // [D3D12: D3D12_FILTER]
  rtapi::SamplerDesc out;
  out.Filter = named(kFilters, filter, "filter");
  out.AddressU = out.AddressV = out.AddressW = named(kAddresses, address, "address");
  if (out.Filter == Filter::kAnisotropic) out.MaxAnisotropy = 16;
  if (!compare.empty()) {
    out.ComparisonFunc = named(kComparisons, compare, "compare");
    out.Filter = static_cast<Filter>(static_cast<uint32_t>(out.Filter) | kCompares);
  }
  std::copy(border.begin(), border.end(), out.BorderColor);
  out.MipLODBias = bias;
  out.MinLOD = lod[0];
  out.MaxLOD = lod[1];
  return out;
}

RayDispatch ray_dispatch(std::string ray_generation, std::vector<Record> miss,
                         std::vector<Record> hit_groups, std::vector<Record> callable,
                         std::vector<std::array<std::string, 4>> groups,
                         std::vector<std::string> local, uint32_t payload_bytes,
                         uint32_t attribute_bytes, uint32_t recursion,
                         std::array<uint32_t, 3> size) {
  return {std::move(ray_generation),
          std::move(miss),
          std::move(hit_groups),
          std::move(callable),
          std::move(groups),
          std::move(local),
          payload_bytes,
          attribute_bytes,
          recursion,
          {size[0], size[1], size[2]}};
}

py::list entries(const Library& library) {
  py::list out;
  for (const rtapi::ShaderExportInfo& one : library.library.GetExports()) out.append(one.Name);
  return out;
}

// kaamos.Error, with the number of rtapi/ERRORS.md as its attribute `id`.
py::object g_error_type;

void set_error(const rtapi::ResultError& error) {
  py::object made = g_error_type(error.what());
  made.attr("id") = error.error().id.text();
  PyErr_SetObject(g_error_type.ptr(), made.ptr());
}

}  // namespace
}  // namespace kaamos::python

PYBIND11_MODULE(_kaamos, m) {
  using namespace kaamos::python;
  m.attr("__version__") = rtapi::GetVersion();
  g_error_type = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc("kaamos.Error",
                                "What the API refuses. `id` is its number in rtapi/ERRORS.md, such "
                                "as \"KA0712\".",
                                PyExc_RuntimeError, nullptr));
  m.attr("Error") = g_error_type;
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const rtapi::ResultError& error) {
      set_error(error);
    }
  });

  py::class_<ArrayBuffer>(m, "Buffer")
      .def_property_readonly("nbytes", [](const ArrayBuffer& b) { return b.buffer.size(); })
      .def("mapped", [](const ArrayBuffer& b) { return mapped_array(b.buffer, b.type, b.shape); });
  py::class_<rtapi::SamplerDesc>(m, "Sampler").def(py::init(&sampler_desc));
  py::class_<ArrayTexture>(m, "Texture").def_property_readonly("shape", [](const ArrayTexture& t) {
    return py::tuple(py::cast(t.shape));
  });
  py::class_<Structure>(m, "Structure");
  py::class_<Library>(m, "Library")
      .def_property_readonly("exports", entries)
      .def_property_readonly("resources", [](const Library& library) {
        py::list names;
        for (const auto& one : library.reflection.Bindings) names.append(one.Name);
        return names;
      });

  py::class_<RayDispatch>(m, "RayDispatch").def(py::init(&ray_dispatch));
  py::class_<Draw>(m, "Draw").def(
      py::init([](std::string vertex, std::string pixel, uint32_t vertices, uint32_t instances,
                  std::string topology, std::string cull, std::string blend, bool wireframe,
                  std::vector<float> clear, bool depth) {
        return Draw{
            std::move(vertex), std::move(pixel), vertices,  instances,        std::move(topology),
            std::move(cull),   std::move(blend), wireframe, std::move(clear), depth};
      }));
  py::class_<Frame>(m, "Frame")
      .def(py::init([](const Session& session, std::string scene, uint32_t width, uint32_t height,
                       std::vector<std::string> effects, uint32_t seed,
                       std::map<std::string, std::string> settings) {
             return std::make_unique<Frame>(
                 session, FrameOptions{std::move(scene), width, height, std::move(effects), seed,
                                       std::move(settings)});
           }),
           py::keep_alive<1, 2>())
      .def("render", &Frame::render)
      .def("layers", &Frame::layers)
      .def("layer", &Frame::layer)
      .def("picture", &Frame::picture);
  m.def("scene_names", scene_names);
  m.def("described_settings", described_settings);

  py::class_<Session>(m, "Session")
      .def(py::init([](const std::string& backend, bool interpret, bool checked, uint32_t threads) {
             return std::make_unique<Session>(DeviceOptions{backend, interpret, checked, threads});
           }),
           py::arg("backend"), py::arg("interpret"), py::arg("checked"), py::arg("threads"))
      .def("compile", compile)
      .def("buffer", make_buffer)
      .def("mapped_buffer", make_mapped_buffer)
      .def("read_buffer", read_buffer)
      .def("texture", make_texture)
      .def("read_texture", read_texture)
      .def("bottom_level",
           [](Session& session, py::object vertices, py::object indices, py::object boxes,
              bool opaque) {
             return build_bottom_level(
                 session, {std::move(vertices), std::move(indices), std::move(boxes), opaque});
           })
      .def(
          "top_level",
          [](Session& session, const std::vector<std::tuple<Structure, py::object, uint32_t,
                                                            uint32_t, uint32_t, uint32_t>>& given) {
            std::vector<Instance> instances;
            for (const auto& [level, transform, id, mask, hit_group, flags] : given) {
              instances.push_back({level, transform, id, mask, hit_group, flags});
            }
            return build_top_level(session, instances);
          })
      .def("dispatch",
           [](Session& session, const Library& library, const std::string& entry,
              std::array<uint32_t, 3> groups, const Bindings& given) {
             session.dispatch(library, entry, {groups[0], groups[1], groups[2]}, given);
           })
      .def("dispatch_rays",
           [](Session& session, const Library& library, const RayDispatch& what,
              const Bindings& given) { dispatch_rays(session, library, what, given); })
      .def("explain_rays",
           [](Session& session, const Library& library, const RayDispatch& what,
              std::array<uint32_t, 3> at, const Bindings& given) {
             const Explanation found = explain_rays(session, library, what, at, given);
             return py::make_tuple(found.text, found.json);
           })
      .def("draw", [](Session& session, const Library& library, const Draw& what,
                      const std::vector<ArrayTexture>& targets,
                      const Bindings& given) { draw(session, library, what, targets, given); })
      .def("take_messages", [](Session& session) {
        py::list out;
        for (const Message& one : session.take_messages()) {
          out.append(py::make_tuple(static_cast<uint32_t>(one.severity), one.id, one.text));
        }
        return out;
      });
}
