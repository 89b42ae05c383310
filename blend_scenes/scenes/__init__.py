# SPDX-License-Identifier: GPL-3.0-or-later
"""The project's scenes; `SCENES` maps the name of each .blend to the function that builds it.

`MODELS` are made from files that are no part of the project: their functions take the folder of
the model, which bears the scene's name. What is made from `NOT_SHIPPED` must not be either.
"""

from . import (
    corridor,
    cornell_box,
    desks,
    geometry_zoo,
    japanese_room,
    lamps,
    modern_hall,
    office,
    soda_hall,
    two_rooms,
)

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

MODELS = {
    "modern_hall": modern_hall.build,
    "soda_hall": soda_hall.build,
}

NOT_SHIPPED = {"soda_hall"}
