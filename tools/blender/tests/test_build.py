# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip: what is in it, and that Blender takes it. The real wheel is the file that FRANGIBLE_WHEEL names."""

import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import bpy
import pytest

HERE = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(HERE))

import build

INSTALL = """
import os, sys, traceback
import bpy
try:
    bpy.ops.extensions.package_install_files(filepath=sys.argv[1], repo="user_default", enable_on_install=True)
    import bl_ext.user_default.frangible as installed
    assert installed.__file__.startswith(os.environ["BLENDER_USER_RESOURCES"]), installed.__file__
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="bl_ext.user_default.frangible")
    bpy.ops.mesh.primitive_cube_add(size=0.1)
    cube, settings = bpy.context.object, bpy.context.scene.frangible
    bpy.context.scene.cursor.location = (0.01, 0.01, 0.05)
    settings.tetrahedra, settings.modes, settings.motion = 3000, 40, "STILL"
    settings.speed, settings.mass, settings.radius = 60, 2, 0.03
    bpy.ops.frangible.break_object()
    print("pieces:", len(bpy.data.collections["Cube"].objects))
except BaseException:
    traceback.print_exc()
sys.stdout.flush()
sys.stderr.flush()
os._exit(0)
"""


@pytest.fixture(scope="module")
def wheel():
    given = os.environ.get("FRANGIBLE_WHEEL")
    assert given, "set FRANGIBLE_WHEEL to the wheel that `cargo xtask python` made"
    return Path(given)


def test_the_same_wheel_gives_the_same_zip(tmp_path):
    wheel = tmp_path / "frangible-1.2.3-cp310-abi3-win_amd64.whl"
    wheel.write_bytes(b"wheel")
    paths = [build.build(wheel, tmp_path / name) for name in ("a", "b")]
    assert paths[0].read_bytes() == paths[1].read_bytes()
    assert paths[0].name == "frangible-1.2.3-windows-x64.zip"
    with zipfile.ZipFile(paths[0]) as package:
        manifest = tomllib.loads(package.read("blender_manifest.toml").decode())
        assert manifest["version"] == "1.2.3" and manifest["platforms"] == ["windows-x64"]
        assert manifest["wheels"] == [f"./wheels/{wheel.name}"] and package.read(f"wheels/{wheel.name}") == b"wheel"
        assert {"__init__.py", "LICENSE", "panel.py"} <= set(package.namelist())


@pytest.mark.parametrize(
    "tags, platforms",
    [
        ("manylinux_2_17_x86_64.manylinux2014_x86_64", ["linux-x64"]),
        ("manylinux_2_35_x86_64", ["linux-x64"]),
        ("macosx_11_0_arm64", ["macos-arm64"]),
        ("macosx_10_12_x86_64", ["macos-x64"]),
        ("macosx_10_12_universal2", ["macos-arm64", "macos-x64"]),
    ],
)
def test_platforms_have_the_names_that_blender_gives_them(tmp_path, tags, platforms):
    wheel = tmp_path / f"frangible-0.1.0-cp310-abi3-{tags}.whl"
    wheel.touch()
    assert build.describe(wheel) == ("0.1.0", platforms)


@pytest.mark.parametrize(
    "name", ["numpy-1.0.0-cp310-abi3-win_amd64.whl", "frangible-0.1.0-cp311-cp311-win_amd64.whl", "frangible-0.1.0-cp310-abi3-any.whl"]
)
def test_other_wheels_are_refused(tmp_path, name):
    wheel = tmp_path / name
    wheel.touch()
    with pytest.raises(SystemExit, match=r"wheel of frangible|does not run"):
        build.build(wheel, tmp_path)
    assert not list(tmp_path.glob("*.zip"))


def test_blender_finds_the_manifest_valid(tmp_path, wheel):
    package = build.build(wheel, tmp_path)
    script = next(Path(bpy.utils.system_resource("SCRIPTS")).rglob("bl_pkg/cli/blender_ext.py"))
    run = subprocess.run([sys.executable, script, "validate", package], capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode == 0 and "Success" in run.stdout, run.stdout + run.stderr


def test_blender_installs_it_and_breaks_a_cube(tmp_path, wheel):
    package = build.build(wheel, tmp_path)
    user = tmp_path / "user"
    user.mkdir()
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(user)}
    run = subprocess.run([sys.executable, "-c", INSTALL, package], env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert "pieces: " in run.stdout, run.stdout + run.stderr
    assert int(run.stdout.split("pieces: ")[1].split()[0]) > 1
    assert list(user.rglob("site-packages/frangible/_frangible*.so")) or list(user.rglob("site-packages/frangible/_frangible*.pyd"))
    shutil.rmtree(user)
