# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes modules of the package from templates: __init__.py, whose functions have the parameters that the extension
module _core lists, and _reports.py, whose types have the keys of the reports:
write_init.py FOLDER_OF_CORE TEMPLATE OUTPUT [TEMPLATE OUTPUT]...
"""

import pathlib
import sys
import textwrap


def keyword(parameter):
    """Returns the parameter as in a signature, such as "order: int | None = 1"."""
    optional = "" if parameter["type"].endswith("None") else " | None"
    return f"{parameter['name']}: {parameter['type']}{optional} = {parameter['default']!r}"


def meaning(parameter):
    """Returns what values the parameter takes, where its type does not say it, and its help."""
    values = ""
    if "of_faces" in parameter:
        values = ("An array of shape (m,) of bools, or indices: only these faces move. " if parameter["of_faces"]
                  else "An array of shape (n,). ")
    elif parameter["type"] == "float | str":
        values = "In units of the mesh, or as '1%' of its bounding box's diagonal. "
    return values + parameter["help"]


def paragraph(parameter):
    """Returns the parameter's paragraph of the docstring, wrapped to 80 columns for Python's help()."""
    def wrapped(text, columns, indent):
        return textwrap.wrap(text, columns, initial_indent=indent * " ", subsequent_indent=12 * " ",
                             break_on_hyphens=False)

    first = f"{parameter['name']}: {parameter['type']} = {parameter['default']!r}"
    return "\n".join(wrapped(first, 80, 8) + wrapped(meaning(parameter), 80, 12))


def key(row):
    """Returns the key of a report as a line of its type, below a comment wrapped to 100 columns."""
    meaning = row["meaning"].replace("*", "").replace("null", "None")
    unit = f" ({row['unit']})" if row["unit"] else ""
    comment = textwrap.wrap(meaning + unit, 100, initial_indent="    # ", subsequent_indent="    # ",
                            break_on_hyphens=False)
    return "\n".join([*comment, f"    {row['name']}: {row['type']}"])


def written(text):
    """Returns the text of a template with what the extension module says."""
    from _core import filters, step_report
    text = text.replace("@KEYS OF step@", "\n".join(map(key, step_report)))
    for name, described in filters.items():
        parameters = described["parameters"]
        line_end = ",\n" + len(f"def {name}(") * " "
        text = text.replace(f"@KEYWORDS OF {name}@", line_end.join(map(keyword, parameters)))
        text = text.replace(f"@HELP OF {name}@", "\n".join(map(paragraph, parameters)))
        text = text.replace(f"@KEYS OF {name}@", "\n".join(map(key, described["report"])))
    return text


def main(folder, *files):
    sys.path.insert(0, folder)
    for template, output in zip(files[::2], files[1::2]):
        text = pathlib.Path(template).read_text(encoding="utf-8")
        pathlib.Path(output).write_text(written(text), encoding="utf-8")


main(*sys.argv[1:])
