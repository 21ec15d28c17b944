# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the extension's zip from this folder and a wheel of the package `frangible`: see README.md beside this file."""

import argparse
import re
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Endings of a wheel's platform, and what Blender calls them.
PLATFORMS = [
    (r"(manylinux\w*|linux)_x86_64", ["linux-x64"]),
    (r"(manylinux\w*|linux)_aarch64", ["linux-arm64"]),
    (r"win_amd64", ["windows-x64"]),
    (r"win_arm64", ["windows-arm64"]),
    (r"macosx_\d+_\d+_arm64", ["macos-arm64"]),
    (r"macosx_\d+_\d+_x86_64", ["macos-x64"]),
    (r"macosx_\d+_\d+_universal2", ["macos-arm64", "macos-x64"]),
]
# The same input gives the same bytes: entries have no time of their own.
NO_TIME = (1980, 1, 1, 0, 0, 0)


def describe(wheel):
    """Version and platforms of a wheel; SystemExit with a sentence where it is none of ours."""
    parts = re.fullmatch(r"frangible-(\d+\.\d+\.\d+)[^-]*-cp3\d+-abi3-([\w.]+)\.whl", wheel.name)
    if parts is None or not wheel.is_file():
        sys.exit(f"{wheel} is no wheel of frangible for all versions of Python (abi3); make one by `cargo xtask python`.")
    version, tags = parts.groups()
    found = [name for tag in tags.split(".") for pattern, names in PLATFORMS if re.fullmatch(pattern, tag) for name in names]
    if not found:
        sys.exit(f"{wheel.name} is for {tags}, which Blender does not run on.")
    return version, sorted(set(found))


def manifest(version, platforms, wheel):
    """The manifest with what depends on the wheel."""
    text = (HERE / "extension/blender_manifest.toml").read_text(encoding="utf-8")
    listed = ", ".join(f'"{platform}"' for platform in platforms)
    for line, filled in (
        ('version = "0.0.0"', f'version = "{version}"'),
        ("platforms = []", f"platforms = [{listed}]"),
        ("wheels = []", f'wheels = ["./wheels/{wheel.name}"]'),
    ):
        assert text.count(f"\n{line}\n") == 1, line
        text = text.replace(f"\n{line}\n", f"\n{filled}\n")
    return text


def build(wheel, folder):
    """Writes the zip into the folder and returns its path."""
    version, platforms = describe(wheel)
    entries = {path.name: path.read_bytes() for path in (HERE / "extension").glob("*.py")}
    entries["LICENSE"] = (HERE.parent / "LICENSE").read_bytes()
    entries["blender_manifest.toml"] = manifest(version, platforms, wheel).encode()
    entries[f"wheels/{wheel.name}"] = wheel.read_bytes()
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"frangible-{version}-{'-'.join(platforms)}.zip"
    with zipfile.ZipFile(path, "w") as package:
        for name in sorted(entries):
            info = zipfile.ZipInfo(name, NO_TIME)
            info.compress_type = zipfile.ZIP_STORED if name.endswith(".whl") else zipfile.ZIP_DEFLATED
            info.external_attr = 0o100644 << 16
            # Else the bytes depend on the system that builds.
            info.create_system = 3
            package.writestr(info, entries[name])
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("wheel", type=Path, help="a wheel that `cargo xtask python` made")
    parser.add_argument("-o", "--output", type=Path, default=Path("."), help="folder for the zip (default: here)")
    given = parser.parse_args()
    print(build(given.wheel, given.output))


if __name__ == "__main__":
    main()
