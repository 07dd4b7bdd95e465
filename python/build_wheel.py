#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""build_wheel.py PACKAGE VERSION LICENCE OUT: makes a wheel of the package in the folder PACKAGE (kaamos/, as
"cmake --install --component python" writes it) in the folder OUT, and prints its path.

The wheel is for the version of Python that the extension module was built for. Libraries that not every Linux has
(Embree, oneTBB and others) are inside, in kaamos.libs, and found there before any of the system's. The platform's tag
says the oldest glibc that has all that is called. The same package gives the same bytes.
"""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

# glibc's parts and the C++ runtime, which Python's own wheels expect of a system too (PEP 513, PEP 600).
EVERYWHERE = re.compile(r"^(linux-vdso|ld-linux.*|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+))[.]so")
TIME = (1980, 1, 1, 0, 0, 0)


def output_of(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def extension_of(package):
    """The extension module, and the tag of its Python: "cp311"."""
    for name in sorted(os.listdir(package) if os.path.isdir(package) else []):
        found = re.match(r"_kaamos[.]cpython-(3\d+)-", name)
        if found:
            return os.path.join(package, name), "cp" + found[1]
    sys.exit(f'"{package}" has no extension module _kaamos.cpython-*.so: build the target kaamos_python first')


def libraries_of(extension):
    """What it needs and not every Linux has: paths by the names under which they are loaded."""
    out = {}
    for line in output_of("ldd", extension).splitlines():
        words = line.split()
        if "not found" in line:
            sys.exit(f"{words[0]}, which {extension} needs, is not installed")
        if "=>" in words and not EVERYWHERE.match(words[0]):
            out[words[0]] = os.path.realpath(words[2])
    return out


def platform_of(files):
    """manylinux_X_Y by the newest version of glibc's symbols that the files use, and the machine. Systems with glibc
    2.34 have the C++ runtime of g++ 11; what needs a newer one is for systems as new as this."""
    newest = (2, 34)
    for file in files:
        symbols = output_of("objdump", "-T", file)
        for major, minor in re.findall(r"\bGLIBC_(\d+)[.](\d+)", symbols):
            newest = max(newest, (int(major), int(minor)))
        if any(int(patch) > 29 for patch in re.findall(r"GLIBCXX_3[.]4[.](\d+)", symbols)):
            here = os.confstr("CS_GNU_LIBC_VERSION").split()[1].split(".")
            newest = max(newest, (int(here[0]), int(here[1])))
    return "manylinux_%d_%d_%s" % (*newest, os.uname().machine)


def stage(package, folder):
    """Copies the package and its libraries, and lets each find the others where they are."""
    shutil.copytree(package, os.path.join(folder, "kaamos"), ignore=shutil.ignore_patterns("__pycache__"))
    extension, _ = extension_of(os.path.join(folder, "kaamos"))
    files = [extension]
    libraries = libraries_of(extension)
    os.mkdir(os.path.join(folder, "kaamos.libs"))
    for name, path in libraries.items():
        files.append(os.path.join(folder, "kaamos.libs", name))
        shutil.copyfile(path, files[-1])
        os.chmod(files[-1], 0o644)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", files[-1]], check=True)
    subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/../kaamos.libs", extension], check=True)
    return files


def describe(folder, version, python, platform, licence):
    info = os.path.join(folder, f"kaamos-{version}.dist-info")
    os.mkdir(info)
    shutil.copyfile(licence, os.path.join(info, "LICENSE"))
    with open(os.path.join(info, "METADATA"), "w") as file:
        file.write("Metadata-Version: 2.1\nName: kaamos\n"
                   f"Version: {version}\n"
                   "Summary: DirectX Raytracing without ray tracing hardware\n"
                   "License: MIT\nRequires-Dist: numpy\n"
                   f"Requires-Python: =={python[2]}.{python[3:]}.*\n")
    with open(os.path.join(info, "WHEEL"), "w") as file:
        file.write("Wheel-Version: 1.0\nGenerator: build_wheel.py\nRoot-Is-Purelib: false\n"
                   f"Tag: {python}-{python}-{platform}\n")
    return info


def pack(folder, info, path):
    """Files in the order of their names, the list of them last."""
    names = sorted(os.path.relpath(os.path.join(at, name), folder)
                   for at, _, files in os.walk(folder) for name in files)
    record = os.path.join(os.path.basename(info), "RECORD")
    rows = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(name, data):
            entry = zipfile.ZipInfo(name, TIME)
            entry.external_attr = 0o100644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)

        for name in names:
            with open(os.path.join(folder, name), "rb") as file:
                data = file.read()
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            rows.append(f"{name},sha256={digest},{len(data)}\n")
            add(name, data)
        add(record, "".join(rows) + f"{record},,\n")


def main():
    package, version, licence, out = sys.argv[1:]
    if not shutil.which("patchelf"):
        sys.exit("patchelf is not installed (Debian: apt install patchelf)")
    _, python = extension_of(package)
    with tempfile.TemporaryDirectory() as folder:
        platform = platform_of(stage(package, folder))
        info = describe(folder, version, python, platform, licence)
        path = os.path.join(out, f"kaamos-{version}-{python}-{python}-{platform}.whl")
        pack(folder, info, path)
    print(path)


main()
