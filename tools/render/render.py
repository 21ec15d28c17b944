# SPDX-License-Identifier: GPL-3.0-or-later
"""Stills and films of a break by Blender's Cycles: see README.md beside this file."""

import argparse
import math
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

try:
    import bpy
except ImportError:
    sys.exit("render.py needs Blender's Python: pip install 'bpy==4.5.*' for Python 3.11, or run it inside Blender")

import studio
import surfaces
from recording import MOMENTS, Recording


def arguments():
    after = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("glb", type=Path, help="GLB file written by `frangible break`")
    parser.add_argument("-o", "--output", type=Path, required=True, help="output: a PNG file, or a folder for a film")
    parser.add_argument("--moment", choices=MOMENTS, default="first-crack")
    parser.add_argument("--time", type=float, help="time of the picture, s after the first frame")
    parser.add_argument("--from", dest="begin", type=float, help="start time of a film, s")
    parser.add_argument("--to", dest="end", type=float, help="end time of a film, s")
    parser.add_argument("--slow", type=float, default=8.0, help="slow-motion factor (default %(default)s)")
    parser.add_argument("--fps", type=float, default=30.0, help="frames per second of the film (default %(default)s)")
    parser.add_argument("--samples", type=int, default=96)
    parser.add_argument("--size", type=size, default=(960, 600), help="WIDTHxHEIGHT in pixels (default 960x600)")
    parser.add_argument("--from-side", type=float, default=0.0, help="angle of the camera around the vertical axis, degrees")
    parser.add_argument("--height", type=float, default=None, help="angle of the camera above the floor, degrees")
    parser.add_argument("--cracks", choices=["ridged", "plain"], default="ridged")
    parser.add_argument("--gpu", action="store_true")
    given = parser.parse_args(after)
    if not given.glb.is_file():
        parser.error(f"there is no file {given.glb}")
    if (given.begin is None) != (given.end is None):
        parser.error("a film needs both --from and --to")
    if given.begin is not None and not 0 <= given.begin < given.end:
        parser.error(f"a film from {given.begin} s to {given.end} s has no length")
    if given.samples < 1 or given.slow <= 0 or given.fps <= 0:
        parser.error("--samples, --slow and --fps are above zero")
    return given


def size(text):
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit() and int(width) > 15 and int(height) > 15):
        raise argparse.ArgumentTypeError(f"{text} is not WIDTHxHEIGHT in pixels, such as 960x600")
    return int(width), int(height)


def set_up_cycles(given):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = given.size
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    cycles = scene.cycles
    cycles.samples = given.samples
    cycles.use_adaptive_sampling = True
    cycles.adaptive_threshold = 0.02
    cycles.use_denoising = True
    cycles.seed = 0
    # A shard has two faces, and there are shards behind shards.
    cycles.max_bounces = cycles.transmission_bounces = 16
    cycles.caustics_reflective = False
    cycles.sample_clamp_indirect = 8.0
    if given.gpu:
        cycles.device = "GPU"
    scene.view_settings.view_transform = "AgX"
    scene.view_settings.look = "AgX - Medium High Contrast"


def picture(at, frame_rate, path):
    """Renders the moment `at`, s, and puts the file under its name when it is whole."""
    scene = bpy.context.scene
    frame = at * frame_rate
    scene.frame_set(math.floor(frame + 1e-6), subframe=max(0.0, frame - math.floor(frame + 1e-6)))
    partial = path.with_name(f".{path.stem}.part.png")
    scene.render.filepath = str(partial)
    bpy.ops.render.render(write_still=True)
    partial.replace(path)


def film(given, recording):
    given.output.mkdir(parents=True, exist_ok=True)
    count = max(1, round((given.end - given.begin) * given.slow * given.fps))
    scene = bpy.context.scene
    # The shutter is open for half a picture of the film, and opens on it: things appear on whole frames, never while it is open.
    scene.render.use_motion_blur = True
    scene.render.motion_blur_position = "START"
    scene.render.motion_blur_shutter = min(0.5, 0.5 * recording.frame_rate / (given.slow * given.fps))
    begun, drawn = time.time(), 0
    for number in range(count):
        path = given.output / f"{number:04}.png"
        if path.exists():
            continue
        picture(given.begin + number / (given.slow * given.fps), recording.frame_rate, path)
        drawn += 1
        left = (time.time() - begun) / drawn * (count - number - 1)
        print(f"{path}: {number + 1} of {count}, {left / 60:.0f} min left", flush=True)


def main():
    given = arguments()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    recording = Recording(given.glb)
    set_up_cycles(given)
    surfaces.dress(ridged=given.cracks == "ridged")
    at = given.time if given.time is not None else recording.moment(given.moment)
    if given.begin is not None:
        shown = [given.begin, 0.5 * (given.begin + given.end), given.end]
    else:
        shown = [at]
    studio.build(recording, shown, given)
    if given.begin is not None:
        film(given, recording)
        return
    begun = time.time()
    given.output.parent.mkdir(parents=True, exist_ok=True)
    picture(at, recording.frame_rate, given.output)
    print(f"{given.output}: {at:.3f} s after the first frame, {time.time() - begun:.0f} s of rendering")


main()
