#!/usr/bin/env python3
# SPDX-FileCopyrightText: The stairwayd authors
# SPDX-License-Identifier: Apache-2.0
"""Decodes the messages FOLDER/<type> and encodes them again as FOLDER/<type>.again; prints the fields of each as JSON.

Usage: decode_messages.py FOLDER TYPE...; the Python package `stairway` must be on the path.
"""
import json
import math
import pathlib
import sys

import stairway


def plain(value):
    if isinstance(value, (list, tuple)):
        return [plain(element) for element in value]
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if hasattr(value, "__slots__"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    return value


folder = pathlib.Path(sys.argv[1])
for name in sys.argv[2:]:
    message = getattr(stairway, name).decode((folder / name).read_bytes())
    (folder / (name + ".again")).write_bytes(message.encode())
    print(json.dumps({"type": name, "message": plain(message)}))
