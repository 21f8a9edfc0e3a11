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
    from _core import filters
    text = pathlib.Path(template).read_text(encoding="utf-8")
    for name, described in filters.items():
        parameters = described["parameters"]
        line_end = ",\n" + len(f"def {name}(") * " "
        text = text.replace(f"@KEYWORDS OF {name}@", line_end.join(map(keyword, parameters)))
        text = text.replace(f"@HELP OF {name}@", "\n".join(map(paragraph, parameters)))
    pathlib.Path(output).write_text(text, encoding="utf-8")


main(*sys.argv[1:])
