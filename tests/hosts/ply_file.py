# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads PLY files for the host tests."""

import struct

CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
         "float": "f", "double": "d", "float32": "f", "float64": "d", "uint8": "B", "int32": "i"}
BYTE_ORDER = {"binary_little_endian": "<", "binary_big_endian": ">"}


class Element:
    """An element of the header. Each of its `rows` is a list of the values of `properties`; a list
    property is a tuple."""

    def __init__(self, name, count):
        self.name, self.count = name, count
        self.properties, self.types, self.rows = [], [], []

    def column(self, name):
        index = self.properties.index(name)
        return [row[index] for row in self.rows]


def read_header(file):
    encoding, elements = "", []
    for line in iter(file.readline, b"end_header\n"):
        words = line.decode().split()
        if words[0] == "format":
            encoding = words[1]
        elif words[0] == "element":
            elements.append(Element(words[1], int(words[2])))
        elif words[0] == "property":
            elements[-1].properties.append(words[-1])
            elements[-1].types.append([CODES[word] for word in words[1:-1] if word != "list"])
    return encoding, elements


def read_ascii_row(words, types):
    row = []
    for codes in types:
        if len(codes) == 1:
            row.append(float(next(words)))
        else:
            row.append(tuple(float(next(words)) for _ in range(int(next(words)))))
    return row


def read_binary_row(file, order, types):
    def read(codes):
        packed = struct.Struct(order + codes)
        return packed.unpack(file.read(packed.size))

    row = []
    for codes in types:
        value = read(codes[0])
        row.append(value[0] if len(codes) == 1 else read(f"{value[0]}{codes[1]}"))
    return row


def read_rows(file, encoding, element):
    if encoding == "ascii":
        for _ in range(element.count):
            yield read_ascii_row(iter(file.readline().split()), element.types)
    elif all(len(codes) == 1 for codes in element.types):
        row = struct.Struct(BYTE_ORDER[encoding] + "".join(codes[0] for codes in element.types))
        yield from map(list, row.iter_unpack(file.read(row.size * element.count)))
    else:
        for _ in range(element.count):
            yield read_binary_row(file, BYTE_ORDER[encoding], element.types)


def read_ply(path):
    """Returns the {name: Element} of a file."""
    with open(path, "rb") as file:
        encoding, elements = read_header(file)
        for element in elements:
            element.rows = list(read_rows(file, encoding, element))
    return {element.name: element for element in elements}


def positions(elements):
    """Returns x, y and z of each vertex."""
    vertices = elements["vertex"]
    return list(zip(*(vertices.column(axis) for axis in "xyz")))
