# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the package's __init__.py, whose functions have the parameters that the extension module _core lists:
write_init.py FOLDER_OF_CORE TEMPLATE OUTPUT
"""

import pathlib
import sys
import textwrap


def keyword(parameter):
    """Returns the parameter as in a signature, such as "order: int | None = 1"."""
    optional = "" if parameter["type"].endswith("None") else " | None"
    return f"{parameter['name']}: {parameter['type']}{optional} = {parameter['default']!r}"


def paragraph(parameter):
    """Returns the parameter's paragraph of the docstring, wrapped to 80 columns for Python's help()."""
    def wrapped(text, columns, indent):
        return textwrap.wrap(text, columns, initial_indent=indent * " ", subsequent_indent=12 * " ",
                             break_on_hyphens=False)

    first = f"{parameter['name']}: {parameter['type']} = {parameter['default']!r}"
    return "\n".join(wrapped(first, 80, 8) + wrapped(parameter["help"], 80, 12))


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
