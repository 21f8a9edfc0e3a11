# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the package's __init__.py, whose functions have the parameters that the extension module _core lists:
write_init.py FOLDER_OF_CORE TEMPLATE OUTPUT
"""

import pathlib
import sys
import textwrap


def keyword(parameter):
    """Returns the parameter as in a signature, such as "order: int = 1"."""
    return f"{parameter['name']}: {parameter['type']} = {parameter['default']!r}"


def paragraph(parameter):
    text = textwrap.indent(textwrap.fill(parameter["help"], 100), 4 * " ")
    return textwrap.indent(f"{keyword(parameter)}\n{text}", 8 * " ")


def main(folder, template, output):
    sys.path.insert(0, folder)
    from _core import parameters
    text = pathlib.Path(template).read_text(encoding="utf-8")
    text = text.replace("@KEYWORDS@", (",\n" + 11 * " ").join(map(keyword, parameters)))
    text = text.replace("@HELP@", "\n".join(map(paragraph, parameters)))
    pathlib.Path(output).write_text(text, encoding="utf-8")


main(*sys.argv[1:])
