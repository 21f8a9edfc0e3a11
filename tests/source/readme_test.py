#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that the marked numbers of README and of the page "How good is it?" are those of the kept pages of tests/research.

A comment follows one number, or several that are separated by commas or a table's lines: <!-- PAGE; NAME; NAME... -->.
PAGE is a file of tests/research. Names that are heads of one of its tables select columns, the others must all be cells of
one row. The numbers must be those of these cells in order, rounded. A single name that is no cell begins the number's own
line of the page: <!-- removing_noise.md; Other scans: RMS over Taubin, geometric mean -->.
"""

import pathlib
import re
import unittest

TOP = pathlib.Path(__file__).resolve().parents[2]
NUMBER = r"(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?"
MARKED = re.compile(rf"((?:{NUMBER} ?(?:°|%|s)?(?:, | \| | ?))+)<!-- (\S+\.md); (.+?) -->")


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def texts_of(page, names):
    """Returns the texts of a page that have the numbers of these names, one for each place that fits."""
    found, heads = [], []
    for line, after in zip(page, page[1:] + [""]):
        if re.match(r"\|[ -]+\|[ |-]*$", after):
            heads = cells_of(line)
        cells, columns = cells_of(line), [name for name in names if name in heads]
        if line.startswith("|") and columns and set(names) - set(columns) <= set(cells) and cells != heads:
            found.append(", ".join(cells[heads.index(name)] for name in columns))
        if len(names) == 1 and f"{names[0]}: " in line:
            found.append(line.split(f"{names[0]}: ", 1)[1])
    return found


def agree(numbers, kept):
    """Returns whether the kept numbers begin with these, rounded."""
    def value(number):
        return float(number.replace(",", ""))

    return len(numbers) <= len(kept) and all(
        abs(value(a) - value(b)) <= 0.5000001 * 10.0 ** -len(a.partition(".")[2]) for a, b in zip(numbers, kept))


def problems_of(readme):
    """Returns a line for each comment whose numbers are not those of its page."""
    problems = []
    for numbers, name, names in MARKED.findall(readme):
        pages = list((TOP / "tests" / "research").rglob(name))
        texts = texts_of(pages[0].read_text(encoding="utf-8").splitlines(), names.split("; ")) if len(pages) == 1 else []
        kept = re.findall(NUMBER, texts[0]) if len(texts) == 1 else []
        if not agree(re.findall(NUMBER, numbers), kept):
            problems.append(f"{numbers.strip()}: {name}, {names}, has {texts}")
    return problems


class ReadmeTest(unittest.TestCase):
    def test_marked_numbers_are_those_of_the_pages(self):
        for name in "README.md", "tests/research/how_good.md":
            with self.subTest(name):
                page = (TOP / name).read_text(encoding="utf-8")
                self.assertGreater(len(MARKED.findall(page)), 0)
                self.assertEqual(len(MARKED.findall(page)), page.count(".md; "), "a comment follows no number")
                self.assertEqual(problems_of(page), [])

    def test_finds_wrong_numbers(self):
        right = "7,993 <!-- meshes.md; `hand_8k`; vertices, faces -->"
        self.assertEqual(problems_of(right), [])
        for wrong in f"1{right}", right.replace("hand_8k", "hand_9k"), right.replace("meshes", "meches"):
            self.assertEqual(len(problems_of(wrong)), 1, wrong)


if __name__ == "__main__":
    unittest.main()
