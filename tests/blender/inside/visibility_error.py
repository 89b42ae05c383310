# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of several settings of `visibility`.

arguments: as JSON [[SCENE.blend, [{option: value}, ...], {keyword: value}], ...], the keywords
of compare_visibility(). Result: for each a list of one dict for each set of options.
"""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
import visibility_ways  # noqa: E402

recorder.finish([visibility_ways.compare(*job) for job in json.loads(recorder.arguments()[0])])
