# SPDX-License-Identifier: MIT
"""Conan 2: "conan create scripts/packaging --build=missing" from the top-level folder. CMake's find_package(kaamos)
finds what Kaamos itself installs."""

import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class KaamosRecipe(ConanFile):
    name = "kaamos"
    description = "DirectX Raytracing without ray tracing hardware"
    license = "MIT"
    topics = ("raytracing", "directx", "hlsl", "vulkan")
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"

    @property
    def _top(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._top, "rtapi", "include", "rtapi", "version.h"))
        self.version = ".".join(re.findall(r" kVersion(?:Major|Minor|Patch) = (\d+);", header))

    def export_sources(self):
        copy(self, "*", src=self._top, dst=self.export_sources_folder, excludes=("build/*", "out/*", ".cache/*", ".git/*"))

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        for package in ("embree/[>=3.13]", "onetbb/[>=2021.4]", "glm/[>=0.9.9]", "tinygltf/[>=2.7]",
                        "nlohmann_json/[>=3.11]", "stb/cci.20230920", "openexr/[>=3.1]", "imath/[>=3.1]",
                        "libpng/[>=1.6]", "draco/[>=1.5]", "meshoptimizer/[>=0.18]", "libwebp/[>=1.2]", "fmt/[>=9.1]",
                        "boost/[>=1.74]", "libffi/[>=3.4]", "glslang/[>=11]", "spirv-tools/[>=1.3]"):
            self.requires(package, transitive_headers=True)
        for package in ("cli11/[>=2.1]", "pugixml/[>=1.12]", "xxhash/[>=0.8]", "vulkan-headers/[>=1.3]",
                        "volk/[>=1.3]", "directx-headers/[>=1.606]"):
            self.requires(package)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["KAAMOS_BUILD_TESTS"] = False
        toolchain.cache_variables["KAAMOS_BUILD_EXAMPLES"] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "kaamos")]
