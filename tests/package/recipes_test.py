# SPDX-License-Identifier: MIT
"""Checks the recipes for other package managers, containers and hosted CI, none of which this build runs.

recipes_test.py ROOT BUILD CMAKE         those of the project at ROOT: exit status 1 and one line for each fault
recipes_test.py ROOT BUILD CMAKE --self  whether the check finds each of FAULTS when it is put into one of them
Exit status 77 without PyYAML (Debian: python3-yaml), which ctest counts as skipped.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import types

try:
    import yaml
except ImportError:
    print("PyYAML is not installed (Debian: python3-yaml)")
    sys.exit(77)

PORT = "cmake/packaging/vcpkg/kaamos/vcpkg.json"
PORTFILE = "cmake/packaging/vcpkg/kaamos/portfile.cmake"
CONAN = "scripts/packaging/conanfile.py"
DOCKER = "scripts/packaging/Dockerfile"
ACTION = ".github/actions/kaamos-test/action.yml"
RECIPES = (PORT, PORTFILE, CONAN, DOCKER, ACTION, "rtapi/include/rtapi/version.h", "LICENSE", "CMakeLists.txt")
# Commands of vcpkg that a port may call.
VCPKG = ("vcpkg_cmake_configure", "vcpkg_cmake_install", "vcpkg_cmake_config_fixup", "vcpkg_copy_tools",
         "vcpkg_install_copyright")
# What CMake calls otherwise than the package managers do.
OTHER_NAMES = {"Boost": "boost", "TBB": "tbb", "nlohmann_json": "nlohmann", "PNG": "png", "TinyGLTF": "tinygltf"}
FAULTS = (
    (PORT, '"version": "0', '"version": "7'),
    (PORT, '    "embree",\n', ""),
    (PORT, '"tbb",', '"tbb"'),
    (PORTFILE, "vcpkg_copy_tools(", "vcpkg_copy_tool("),
    (PORTFILE, "../../../..", "../../.."),
    (PORTFILE, "KAAMOS_BUILD_TESTS", "KAAMOS_WITH_TESTS"),
    (CONAN, '"draco/[>=1.5]", ', ""),
    (CONAN, "kVersion(?:Major", "Version(?:Major"),
    (CONAN, "self.cpp_info.builddirs", "self.info.builddirs"),
    (DOCKER, "scripts/package --debian", "scripts/package --deb"),
    (DOCKER, "--from=build", "--from=builder"),
    (DOCKER, "&& apt-get update", "&& if apt-get update"),
    (DOCKER, "kaamos-verify --require vulkan", "kaamos-verify --needs vulkan"),
    (ACTION, "using: composite", "using: container"),
    (ACTION, "${{ inputs.executors }}", "${{ inputs.where }}"),
    (ACTION, "        exit $failed", "        exit 0"),
    (ACTION, "status != 77", "status != 76"),
    (ACTION, "        for file in", "        for"),
    (ACTION, "scripts/packaging/Dockerfile", "scripts/Dockerfile"),
)


def text_of(root, name):
    with open(os.path.join(root, name), encoding="utf-8") as file:
        return file.read()


def version_of(root):
    return ".".join(re.findall(r" kVersion(?:Major|Minor|Patch) = (\d+);", text_of(root, "rtapi/include/rtapi/version.h")))


def dependencies(build):
    """What an installed Kaamos asks CMake for, in lower case."""
    names = re.findall(r"find_dependency\((\w+)", text_of(build, "kaamosConfig.cmake"))
    return [OTHER_NAMES.get(name, name.lower()) for name in names if name != "Threads"]


def check_options(root, name, text):
    """Options that a recipe sets are those of CMakeLists.txt."""
    known = set(re.findall(r"^option\((KAAMOS_\w+)", text_of(root, "CMakeLists.txt"), re.MULTILINE))
    for option in re.findall(r"KAAMOS_(?:BUILD|WITH)\w*", text):
        if option not in known:
            yield f"{name}: there is no option {option}"


def check_port(root, build, cmake):
    try:
        port = json.loads(text_of(root, PORT))
    except ValueError as error:
        yield f"{PORT}: {error}"
        return
    if port.get("version") != version_of(root):
        yield f"{PORT}: version {port.get('version')} instead of {version_of(root)}"
    names = [one if isinstance(one, str) else one["name"] for one in port["dependencies"]]
    for name in dependencies(build):
        if not any(name in each for each in names):
            yield f"{PORT}: does not depend on {name}"
    text = text_of(root, PORTFILE)
    yield from check_options(root, PORTFILE, text)
    with tempfile.TemporaryDirectory() as folder:
        script = os.path.join(folder, "port.cmake")
        with open(script, "w", encoding="utf-8") as file:
            file.write("".join(f"function({name})\nendfunction()\n" for name in VCPKG))
            file.write(f'set(CURRENT_PACKAGES_DIR "{folder}/packages")\ninclude("{root}/{PORTFILE}")\n')
            file.write('if(NOT EXISTS "${SOURCE_PATH}/CMakeLists.txt")\nmessage(FATAL_ERROR "no sources")\nendif()\n')
        run = subprocess.run([cmake, "-P", script], capture_output=True, text=True, check=False)
        if run.returncode:
            yield f"{PORTFILE}: {run.stderr.strip()}"


def conan_modules():
    """Stands in for Conan: notes what a recipe asks for."""
    class Recipe:
        class info_of_package:
            __slots__ = ("builddirs", "properties")

            def set_property(self, name, value):
                self.properties = {name: value}

        def __init__(self, folder):
            self.recipe_folder, self.asked = folder, []
            self.cpp_info = Recipe.info_of_package()

        def requires(self, reference, **_):
            self.asked.append(reference)

    def load(_, path):
        with open(path, encoding="utf-8") as file:
            return file.read()

    modules = {"conan": {"ConanFile": Recipe}, "conan.tools": {},
               "conan.tools.cmake": dict.fromkeys(("CMake", "CMakeDeps", "CMakeToolchain", "cmake_layout")),
               "conan.tools.files": {"copy": None, "load": load}}
    for name, members in modules.items():
        module = types.ModuleType(name)
        vars(module).update(members)
        sys.modules[name] = module


def check_conan(root, build):
    conan_modules()
    scope = {"__name__": "recipe"}
    try:
        exec(compile(text_of(root, CONAN), CONAN, "exec"), scope)
        recipe = scope["KaamosRecipe"](os.path.join(root, os.path.dirname(CONAN)))
        recipe.set_version()
        recipe.requirements()
        recipe.package_info()
    except Exception as error:  # whatever a recipe may raise
        yield f"{CONAN}: {type(error).__name__}: {error}"
        return
    if recipe.version != version_of(root):
        yield f"{CONAN}: version {recipe.version} instead of {version_of(root)}"
    for name in dependencies(build):
        if not any(name in each for each in recipe.asked):
            yield f"{CONAN}: does not require {name}"
    yield from check_options(root, CONAN, text_of(root, CONAN))


def check_docker(root, build):
    lines = re.sub(r"\\\n", " ", re.sub(r"^#.*\n", "", text_of(root, DOCKER), flags=re.MULTILINE))
    stages = set()
    for line in filter(None, lines.splitlines()):
        word, _, rest = line.partition(" ")
        if word not in ("FROM", "COPY", "WORKDIR", "RUN", "ENV", "CMD"):
            yield f'{DOCKER}: there is no instruction "{word}"'
        if word == "FROM":
            stages.update(re.findall(r" AS (\w+)$", rest))
        for stage in re.findall(r"--from=(\w+)", rest):
            if stage not in stages:
                yield f'{DOCKER}: there is no stage "{stage}"'
        if word == "RUN":
            shell = subprocess.run(["bash", "-n"], input=rest, capture_output=True, text=True, check=False)
            if shell.returncode:
                yield f'{DOCKER}: the shell does not take "{rest.strip()}"'
            for program, name in ((os.path.join(root, "scripts/package"), "scripts/package"),
                                  (os.path.join(build, "bin/kaamos-verify"), "kaamos-verify")):
                called = re.search(rf"{name} ([^&]*)", rest)
                if called and os.path.exists(program):
                    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
                    for option in re.findall(r"--[a-z]+", called[1]):
                        if not re.search(rf"{option}\b", text):
                            yield f"{DOCKER}: {name} has no option {option}"


# Plays docker: says with what it was called, and fails for the files that say so.
FAKE_DOCKER = """#!/bin/sh
echo "docker $*" >> calls
case "$*" in *broken*) exit 1 ;; *skipped*) exit 77 ;; esac
"""


def run_action(step, inputs, folder):
    """Runs a step as the hosted CI would; returns its exit status and the calls of docker."""
    def value(match):
        expression = match[1].strip()
        names = re.findall(r"inputs[.](\w+)", expression)
        default = re.findall(r"[|][|] '([^']*)'", expression)
        return (inputs.get(names[0]) if names else "") or (default[0] if default else "")

    environment = {name: re.sub(r"\$\{\{(.*?)\}\}", value, text) for name, text in step.get("env", {}).items()}
    environment["PATH"] = folder + "/bin:" + os.environ["PATH"]
    calls = os.path.join(folder, "calls")
    if os.path.exists(calls):
        os.remove(calls)
    run = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]], cwd=folder,
                         env=environment, capture_output=True, text=True, check=False)
    return run.returncode, text_of(folder, "calls").splitlines() if os.path.exists(calls) else []


def check_action(root):
    try:
        action = yaml.safe_load(text_of(root, ACTION))
    except yaml.YAMLError as error:
        yield f"{ACTION}: {error}"
        return
    if action["runs"].get("using") != "composite":
        yield f'{ACTION}: runs using "{action["runs"].get("using")}"'
    steps = action["runs"]["steps"]
    for name in re.findall(r"\binputs[.](\w+)", json.dumps(steps)):
        if name not in action["inputs"]:
            yield f'{ACTION}: there is no input "{name}"'
    for step in steps:
        if step.get("shell") != "bash":
            yield f'{ACTION}: "{step.get("name")}" has no shell'
    for path in re.findall(r"\$KAAMOS_SOURCE/([\w/]+)", json.dumps(steps)):
        if not os.path.exists(os.path.join(root, path)):
            yield f"{ACTION}: there is no {path}"
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(folder + "/bin")
        with open(folder + "/bin/docker", "w", encoding="utf-8") as file:
            file.write(FAKE_DOCKER)
        os.chmod(folder + "/bin/docker", 0o755)
        for name in ("a_test.hlsl", "b_test.hlsl", "broken.hlsl", "skipped.hlsl"):
            open(os.path.join(folder, name), "w").close()
        inputs = {name: one.get("default", "") for name, one in action["inputs"].items()}
        for files, status, calls in (("*_test.hlsl", 0, 2), ("broken.hlsl a_test.hlsl", 1, 2), ("skipped.hlsl", 0, 1),
                                     ("none*.hlsl", 1, 0)):
            found = run_action(steps[-1], {**inputs, "files": files, "executors": "embree", "junit": "out"}, folder)
            if found[0] != status or len(found[1]) != calls:
                yield f"{ACTION}: with files {files} it ends with {found[0]} after {len(found[1])} runs, not {status} after {calls}"
            for call in found[1]:
                if "--on embree" not in call or "--junit out/" not in call or " kaamos kaamos-test " not in call:
                    yield f"{ACTION}: {call}"


def faults_of(root, build, cmake):
    yield from check_port(root, build, cmake)
    yield from check_conan(root, build)
    yield from check_docker(root, build)
    yield from check_action(root)


def check_self(root, build, cmake):
    yield from faults_of(root, build, cmake)  # what is broken already cannot be broken to see whether it is found
    for name, old, new in FAULTS:
        with tempfile.TemporaryDirectory() as copy:
            for recipe in RECIPES:
                os.makedirs(os.path.dirname(os.path.join(copy, recipe)), exist_ok=True)
                shutil.copy(os.path.join(root, recipe), os.path.join(copy, recipe))
            shutil.copytree(os.path.join(root, "scripts"), os.path.join(copy, "scripts"), dirs_exist_ok=True)
            text = text_of(copy, name)
            if old not in text:
                yield f'{name} has no "{old}" to break'
                continue
            with open(os.path.join(copy, name), "w", encoding="utf-8") as file:
                file.write(text.replace(old, new))
            if not list(faults_of(copy, build, cmake)):
                yield f'"{new}" instead of "{old}" in {name} is not found'


def main():
    root, build, cmake = sys.argv[1:4]
    faults = list((check_self if "--self" in sys.argv else faults_of)(root, build, cmake))
    print("\n".join(faults) or "no fault")
    sys.exit(1 if faults else 0)


main()
