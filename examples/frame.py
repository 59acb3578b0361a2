#!/usr/bin/env python3
"""Draws one frame of a walk, from where it begins, with the Python package: frame.py WALK OUT.ppm"""
import sys

import acentric


def main(source: str, out: str) -> None:
    with acentric.open(source) as walk:
        rgba = walk.render(walk.start_view()).rgba
        print(f"{out}: {walk.info.name}, {walk.memory / 1e6:.1f} MB in memory")
    height, width, _ = rgba.shape
    with open(out, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (width, height) + rgba[..., :3].tobytes())


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: frame.py WALK OUT.ppm")
    try:
        main(sys.argv[1], sys.argv[2])
    except (acentric.Error, OSError) as error:
        sys.exit(str(error))
