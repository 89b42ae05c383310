# SPDX-License-Identifier: GPL-3.0-or-later
"""The project's scenes; `SCENES` maps the name of each .blend to the function that builds it."""

from . import corridor, cornell_box, desks, geometry_zoo, japanese_room, lamps, office, two_rooms

SCENES = {
    "cornell_box": cornell_box.build,
    "corridor": corridor.build,
    "desks": desks.build,
    "geometry_zoo": geometry_zoo.build,
    "japanese_room": japanese_room.build,
    "lamp_area": lamps.build_area,
    "lamp_point": lamps.build_point,
    "lamp_spot": lamps.build_spot,
    "lamp_sun": lamps.build_sun,
    "office": office.build,
    "two_rooms": two_rooms.build,
}
