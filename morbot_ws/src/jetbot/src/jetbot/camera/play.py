"""Writes JPEGs to the standard output: play.py FOLDER|fake WIDTH HEIGHT FPS QUALITY [ROTATION].

It needs numpy and PIL only. ROTATION: 0 (the default) or 180 degrees.
"""

import itertools
import sys
import time
from pathlib import Path
from typing import Iterator

import numpy
from lens import HEIGHT, rays  # a neighbour: this file runs by itself
from PIL import Image

FLOOR, LINE, SKY = (120, 125, 130), (235, 200, 40), (190, 210, 230)  # RGB
LINE_WIDTH, TILE = 0.05, 0.25  # m


def floor_with_line(width: int, height: int) -> Image.Image:
    """Return the picture of a tiled floor, on which a line leads ahead and bends to the left."""
    down, left = rays(width, height)
    x = HEIGHT / numpy.where(down > 0, down, numpy.inf)
    y = left * x
    tiles = 8 * ((numpy.floor(x / TILE) + numpy.floor(y / TILE)) % 2)
    picture = numpy.array(FLOOR) + tiles[:, :, None]
    picture[abs(y - 0.3 * x ** 2) < LINE_WIDTH / 2] = LINE
    picture[down[:, 0] <= 0] = SKY
    return Image.fromarray(picture.astype(numpy.uint8))


def pictures_of(name: str, width: int, height: int) -> Iterator[Image.Image]:
    """Yield the pictures of a source, for ever; a folder's in the order of their names."""
    if name == "fake":
        yield from itertools.repeat(floor_with_line(width, height))
    while True:
        files = sorted(file for file in Path(name).iterdir() if file.suffix.lower() in (".jpg", ".jpeg", ".png"))
        if not files:
            sys.exit(f"{name} has no pictures: .jpg or .png")
        for file in files:
            with Image.open(file) as image:
                yield image.convert("RGB").resize((width, height), Image.BILINEAR)


def main(name: str, *numbers: str) -> None:
    width, height, fps, quality, rotation = map(int, (*numbers, "0")[:5])
    for picture in pictures_of(name, width, height):
        picture.rotate(rotation).save(sys.stdout.buffer, "JPEG", quality=quality)
        sys.stdout.buffer.flush()
        time.sleep(1 / fps)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (BrokenPipeError, KeyboardInterrupt):
        sys.stderr.close()  # nobody looks any more
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}" if error.filename else str(error))
