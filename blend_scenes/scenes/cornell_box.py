# SPDX-License-Identifier: GPL-3.0-or-later
"""The Cornell box: measured geometry, reflectances and lamp.

Data: Cornell University Program of Computer Graphics, "Cornell Box Data" (1998),
https://www.graphics.cornell.edu/online/box/data.html, in mm with Y up and Z away from the camera.
Where this departs: the floor is cut around the two blocks, which have no undersides, and the
ceiling around the lamp, so that no part of a surface lies under another one.

From spectra to linear Rec.709: the spectra (4 nm steps) are integrated against the CIE 1931
colour matching functions, in the analytic fit of Wyman, Sloan and Shirley 2013 ("Simple Analytic
Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), multi-lobe fit), and taken to
linear Rec.709.  A reflectance in RGB is the colour of the surface under the box's own lamp over the
colour of that lamp, channel by channel: so the first bounce off each surface has exactly the
colour that the spectra give it.
"""

import math

from mathutils import Matrix, Vector

from . import kit

# Published vertices (mm).
FLOOR = ((552.8, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 559.2), (549.6, 0.0, 559.2))
LIGHT = ((343.0, 548.8, 227.0), (343.0, 548.8, 332.0), (213.0, 548.8, 332.0), (213.0, 548.8, 227.0))
CEILING = ((556.0, 548.8, 0.0), (556.0, 548.8, 559.2), (0.0, 548.8, 559.2), (0.0, 548.8, 0.0))
BACK_WALL = ((549.6, 0.0, 559.2), (0.0, 0.0, 559.2), (0.0, 548.8, 559.2), (556.0, 548.8, 559.2))
RIGHT_WALL = ((0.0, 0.0, 559.2), (0.0, 0.0, 0.0), (0.0, 548.8, 0.0), (0.0, 548.8, 559.2))
LEFT_WALL = ((552.8, 0.0, 0.0), (549.6, 0.0, 559.2), (556.0, 548.8, 559.2), (556.0, 548.8, 0.0))
SHORT_BLOCK_TOP = ((130.0, 165.0, 65.0), (82.0, 165.0, 225.0), (240.0, 165.0, 272.0), (290.0, 165.0, 114.0))
TALL_BLOCK_TOP = ((423.0, 330.0, 247.0), (265.0, 330.0, 296.0), (314.0, 330.0, 456.0), (472.0, 330.0, 406.0))
CAMERA = (278.0, 273.0, -800.0)  # looks along +Z; focal length 35 mm, film 25 x 25 mm

# Measured reflectances and the lamp's emission (no unit given), 400 to 700 nm.
REFLECTANCE_WAVELENGTHS = range(400, 701, 4)
WHITE = (
    0.343, 0.445, 0.551, 0.624, 0.665, 0.687, 0.708, 0.723, 0.715, 0.710, 0.745, 0.758, 0.739,
    0.767, 0.777, 0.765, 0.751, 0.745, 0.748, 0.729, 0.745, 0.757, 0.753, 0.750, 0.746, 0.747,
    0.735, 0.732, 0.739, 0.734, 0.725, 0.721, 0.733, 0.725, 0.732, 0.743, 0.744, 0.748, 0.728,
    0.716, 0.733, 0.726, 0.713, 0.740, 0.754, 0.764, 0.752, 0.736, 0.734, 0.741, 0.740, 0.732,
    0.745, 0.755, 0.751, 0.744, 0.731, 0.733, 0.744, 0.731, 0.712, 0.708, 0.729, 0.730, 0.727,
    0.707, 0.703, 0.729, 0.750, 0.760, 0.751, 0.739, 0.724, 0.730, 0.740, 0.737,
)  # fmt: skip
GREEN = (
    0.092, 0.096, 0.098, 0.097, 0.098, 0.095, 0.095, 0.097, 0.095, 0.094, 0.097, 0.098, 0.096,
    0.101, 0.103, 0.104, 0.107, 0.109, 0.112, 0.115, 0.125, 0.140, 0.160, 0.187, 0.229, 0.285,
    0.343, 0.390, 0.435, 0.464, 0.472, 0.476, 0.481, 0.462, 0.447, 0.441, 0.426, 0.406, 0.373,
    0.347, 0.337, 0.314, 0.285, 0.277, 0.266, 0.250, 0.230, 0.207, 0.186, 0.171, 0.160, 0.148,
    0.141, 0.136, 0.130, 0.126, 0.123, 0.121, 0.122, 0.119, 0.114, 0.115, 0.117, 0.117, 0.118,
    0.120, 0.122, 0.128, 0.132, 0.139, 0.144, 0.146, 0.150, 0.152, 0.157, 0.159,
)  # fmt: skip
RED = (
    0.040, 0.046, 0.048, 0.053, 0.049, 0.050, 0.053, 0.055, 0.057, 0.056, 0.059, 0.057, 0.061,
    0.061, 0.060, 0.062, 0.062, 0.062, 0.061, 0.062, 0.060, 0.059, 0.057, 0.058, 0.058, 0.058,
    0.056, 0.055, 0.056, 0.059, 0.057, 0.055, 0.059, 0.059, 0.058, 0.059, 0.061, 0.061, 0.063,
    0.063, 0.067, 0.068, 0.072, 0.080, 0.090, 0.099, 0.124, 0.154, 0.192, 0.255, 0.287, 0.349,
    0.402, 0.443, 0.487, 0.513, 0.558, 0.584, 0.620, 0.606, 0.609, 0.651, 0.612, 0.610, 0.650,
    0.638, 0.627, 0.620, 0.630, 0.628, 0.642, 0.639, 0.657, 0.639, 0.635, 0.642,
)  # fmt: skip
LIGHT_REFLECTANCE = 0.78
LIGHT_WAVELENGTHS = (400, 500, 600, 700)
LIGHT_EMISSION = (0.0, 8.0, 15.6, 18.4)

# The data give no unit for the emission; this one makes a well exposed picture, W/(m2 sr).
EMISSION_SCALE = 2.0

# CIE XYZ to linear Rec.709 with a D65 white (ITU-R BT.709).
XYZ_TO_REC709 = Matrix(
    (
        (3.2404542, -1.5371385, -0.4985314),
        (-0.9692660, 1.8760108, 0.0415560),
        (0.0556434, -0.2040259, 1.0572252),
    )
)


def colour_matching(wavelength):
    """CIE 1931 (x, y, z) at `wavelength` nm; Wyman et al. 2013, Eq. 4 and its table 1."""

    def lobe(height, mean, below, above):
        width = below if wavelength < mean else above
        return height * math.exp(-0.5 * ((wavelength - mean) * width) ** 2)

    return Vector(
        (
            lobe(0.362, 442.0, 0.0624, 0.0374)
            + lobe(1.056, 599.8, 0.0264, 0.0323)
            + lobe(-0.065, 501.1, 0.0490, 0.0382),
            lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
            lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
        )
    )


def light_emission(wavelength):
    """The lamp's emission at `wavelength` nm, linear between the published values."""
    for i in range(len(LIGHT_WAVELENGTHS) - 1):
        low, high = LIGHT_WAVELENGTHS[i : i + 2]
        if low <= wavelength <= high:
            t = (wavelength - low) / (high - low)
            return LIGHT_EMISSION[i] * (1.0 - t) + LIGHT_EMISSION[i + 1] * t
    raise ValueError(f"no emission is given at {wavelength} nm")


def rec709(spectrum):
    """Linear Rec.709 of [(wavelength, value)...]; a flat spectrum of 1 has luminance 1."""
    xyz = Vector((0.0, 0.0, 0.0))
    luminance_of_one = 0.0
    for wavelength, value in spectrum:
        matching = colour_matching(wavelength)
        xyz += value * matching
        luminance_of_one += matching.y
    return XYZ_TO_REC709 @ xyz / luminance_of_one


def lamp_colour():
    return rec709([(w, light_emission(w)) for w in REFLECTANCE_WAVELENGTHS])


def reflectance_under_lamp(reflectance):
    """Linear Rec.709 albedo of the spectrum `reflectance` as the box's lamp shows it."""
    lit = [(w, r * light_emission(w)) for w, r in zip(REFLECTANCE_WAVELENGTHS, reflectance)]
    return tuple(c / l for c, l in zip(rec709(lit), lamp_colour()))


def to_blender(point):
    """Published mm, Y up, X to the camera's left -> metres, Z up, X to its right, box from 0."""
    x, y, z = point
    return ((556.0 - x) / 1000.0, z / 1000.0, y / 1000.0)


def block(top, material):
    """The sides and top of a block; published tops are clockwise in this mapping's plan."""
    outline = [to_blender(p)[:2] for p in top]
    if _signed_area(outline) < 0.0:
        outline.reverse()
    height = to_blender(top[0])[2]
    return kit.Shape().prism(outline, 0.0, height, material, bottom=False), outline


def _signed_area(outline):
    pairs = zip(outline, outline[1:] + outline[:1])
    return 0.5 * sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairs)


def quad(points, material):
    return kit.Shape().polygon([to_blender(p) for p in points], material)


def ceiling_around_light(material):
    """Four quads from the ceiling's corners to the lamp's, which is flush with it."""
    shape = kit.Shape()
    # Both loops start at (large x, small z) and go round the same way.
    for i in range(4):
        j = (i + 1) % 4
        ring = (CEILING[i], CEILING[j], LIGHT[j], LIGHT[i])
        shape.polygon([to_blender(p) for p in ring], material)
    return shape


def floor_around(outlines, material):
    """The floor less the blocks' footprints, in triangles of about 9 cm joined to quads."""
    outline = [to_blender(p)[:2] for p in FLOOR]
    if _signed_area(outline) < 0.0:
        outline.reverse()
    points, triangles = kit.triangulated_around(outline, outlines, spacing=0.09)
    shape = kit.Shape()
    for triangle in triangles:
        shape.polygon([(*points[i], 0.0) for i in triangle], material)
    return shape


def build():
    kit.new_scene(300, 300)
    white = kit.diffuse("White paint", reflectance_under_lamp(WHITE))
    green = kit.diffuse("Green paint", reflectance_under_lamp(GREEN))
    red = kit.diffuse("Red paint", reflectance_under_lamp(RED))
    emission = lamp_colour()
    strongest = max(emission)
    light = kit.principled_emissive(
        "Light",
        (LIGHT_REFLECTANCE,) * 3,
        tuple(c / strongest for c in emission),
        strongest * EMISSION_SCALE,
    )

    short_block, short_outline = block(SHORT_BLOCK_TOP, white)
    tall_block, tall_outline = block(TALL_BLOCK_TOP, white)
    short_block.object("Short block")
    tall_block.object("Tall block")
    floor_around([short_outline, tall_outline], white).object("Floor")
    ceiling_around_light(white).object("Ceiling")
    quad(LIGHT, light).object("Light")
    quad(BACK_WALL, white).object("Back wall")
    quad(RIGHT_WALL, green).object("Right wall")
    quad(LEFT_WALL, red).object("Left wall")

    eye = to_blender(CAMERA)
    kit.add_camera(eye, (eye[0], eye[1] + 1.0, eye[2]), lens=35.0, sensor=25.0)
