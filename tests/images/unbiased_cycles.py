# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles as the references of this project have it. Runs inside Blender."""


def set_up_cycles(scene, samples, seed):
    """An unbiased picture: no denoiser, no clamping, no thresholds, all the bounces there are."""
    scene.render.engine = "CYCLES"
    scene.render.film_transparent = False
    scene.render.use_compositing = False
    scene.render.use_sequencer = False
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.seed = seed
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = 0.0
    cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.blur_glossy = 0.0
    cycles.max_bounces = 128
    cycles.diffuse_bounces = 128
    # A pixel is the mean over its own area, so that block means of pixels are exact.
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
