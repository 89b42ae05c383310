# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares two pictures as every image test of this project does.

relative RMS = rms(A - B) / mean(B) and bias = mean(A) / mean(B) - 1, in linear RGB, with both
pictures clipped at 4 times the median of the reference B (a few pixels of lamp would outweigh the
rest) and averaged over blocks of pixels (the edges of the picture's pixels are not what is tested).

usage: /usr/bin/python3 tests/images/compare.py PICTURE.exr REFERENCE.exr [--block 4] [--floor .10]
"""

import argparse
import sys
from dataclasses import dataclass

import numpy as np

DEFAULT_BLOCK = 4  # pixels
CLIP = 4.0  # times the median of the reference


@dataclass(frozen=True)
class Comparison:
    relative_rms: float
    bias: float
    mean: float  # of the picture, after clipping
    reference_mean: float  # after clipping

    def __str__(self):
        return (
            f"relative RMS {self.relative_rms:.4f}, bias {self.bias:+.4f} "
            f"(means {self.mean:.5g} and {self.reference_mean:.5g})"
        )


def read_rgb(path):
    """The linear RGB of a picture file, (height, width, 3) float64, row 0 at the top."""
    # Not at the top: the arithmetic below is of use where OpenImageIO's binding is missing.
    import OpenImageIO as oiio

    pixels = oiio.ImageBuf(str(path))
    if pixels.has_error:
        raise OSError(f"{path}: {pixels.geterror()}")
    names = pixels.spec().channelnames
    wanted = [_channel(names, letter, path) for letter in "RGB"]
    values = pixels.get_pixels(oiio.FLOAT)
    return np.asarray(values, dtype=np.float64).reshape(
        pixels.spec().height, pixels.spec().width, len(names)
    )[:, :, wanted]


def _channel(names, letter, path):
    """The index of the channel `letter`, in plain files or as "ViewLayer.Combined.R"."""
    for index, name in enumerate(names):
        if name == letter or name.endswith(f"Combined.{letter}"):
            return index
    raise ValueError(f"{path} has no channel {letter}, only {', '.join(names)}")


def block_means(image, block):
    """(height, width, 3) -> (height // block, width // block, 3); a rest at the edges is dropped."""
    height, width = image.shape[0] // block, image.shape[1] // block
    image = image[: height * block, : width * block]
    return image.reshape(height, block, width, block, -1).mean(axis=(1, 3))


def compare(picture, reference, block=DEFAULT_BLOCK, clip=CLIP):
    """The Comparison of two (height, width, 3) arrays; clip None compares them as they are."""
    picture = np.asarray(picture, dtype=np.float64)
    reference = np.asarray(reference, dtype=np.float64)
    if picture.shape != reference.shape:
        raise ValueError(f"pictures of different shape: {picture.shape} and {reference.shape}")
    if not np.isfinite(picture).all() or not np.isfinite(reference).all():
        raise ValueError("a picture holds NaN or infinity")
    if clip is not None:
        limit = clip * np.median(reference)
        picture = np.minimum(picture, limit)
        reference = np.minimum(reference, limit)
    a, b = block_means(picture, block), block_means(reference, block)
    if b.mean() <= 0.0:
        raise ValueError("the reference is black, or its median is")
    return Comparison(
        relative_rms=float(np.sqrt(np.mean((a - b) ** 2)) / b.mean()),
        bias=float(a.mean() / b.mean() - 1.0),
        mean=float(a.mean()),
        reference_mean=float(b.mean()),
    )


def compare_files(picture, reference, block=DEFAULT_BLOCK, clip=CLIP):
    return compare(read_rgb(picture), read_rgb(reference), block, clip)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("picture")
    parser.add_argument("reference")
    parser.add_argument("--block", type=int, default=DEFAULT_BLOCK, help="block edge, pixels")
    parser.add_argument("--no-clip", action="store_true", help="compare the pixels as they are")
    parser.add_argument("--floor", type=float, help="exit with 1 if the relative RMS is above it")
    options = parser.parse_args(arguments)
    clip = None if options.no_clip else CLIP
    result = compare_files(options.picture, options.reference, options.block, clip)
    print(result)
    return int(options.floor is not None and result.relative_rms > options.floor)


if __name__ == "__main__":
    sys.exit(main())
