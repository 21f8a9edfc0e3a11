#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sends the functions of the Python package tracked_mcf to other processes: pools_test.py PAGE

PAGE is the package's page, whose script for joblib must work.
Ends with 77, which tells CTest that the test was skipped, where a package is not installed.
"""

import functools
import importlib.util
import multiprocessing
import os
import pathlib
import pickle
import resource
import sys
import unittest
import warnings

for package in ("tracked_mcf", "cloudpickle", "joblib", "distributed"):
    if not importlib.util.find_spec(package):
        print(f"skipped: {sys.executable} has no {package}; "
              "external/python_package.sh installs tracked_mcf, pip the others")
        sys.exit(77)

import cloudpickle
import distributed
import joblib
import numpy
import tracked_mcf

# Pyramids without a base.
FACES = numpy.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])
MESHES = [numpy.array([[0, 0, height], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0.1]])
          for height in (0.5, 1.0, 1.5, 2.0)]
OPTIONS = {"depth": 3, "detail_size": "20%", "quality": "displacement"}
smooth = functools.partial(tracked_mcf.smooth, faces=FACES, **OPTIONS)
remove_noise = functools.partial(tracked_mcf.remove_noise, faces=FACES, quality="displacement")


def never(*_):
    return False


def steps_of(function, vertices):
    return [moved.tobytes() for _, moved in function(vertices, FACES, **OPTIONS)]


def with_warnings_as_errors(vertices):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        smooth(vertices, detail_size=0.01)


def with_little_memory(vertices):
    limits = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, limits[1]))
    try:
        smooth(vertices, method="paper", depth=12)
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, limits)


# Functions that raise, the error's class, and words of its message.
WRONG = [
    (functools.partial(smooth, order=5), tracked_mcf.InvalidParameter, "order is 5; give 1 to 4"),
    (functools.partial(smooth, faces=FACES + 9), tracked_mcf.InvalidMesh, "faces refers to vertex 9, "),
    (functools.partial(smooth, progress=never), tracked_mcf.Cancelled, "Stopped as asked."),
    (with_warnings_as_errors, tracked_mcf.MeshWarning, "The detail size is "),
    (with_little_memory, tracked_mcf.NotEnoughMemory, "Choose a smaller depth"),
    (functools.partial(smooth, oder=2), TypeError, "unexpected keyword argument 'oder'"),
]


def bytes_of(results):
    return [(vertices.tobytes(), report["quality"].tobytes()) for vertices, report in results]


class Pickles(unittest.TestCase):
    def test_functions_are_references(self):
        for pickler in (pickle, cloudpickle):
            for function in (tracked_mcf.remove_noise, tracked_mcf.smooth, tracked_mcf.steps,
                             tracked_mcf.default_detail_size):
                data = pickler.dumps(function)
                self.assertIs(pickle.loads(data), function)
                self.assertLess(len(data), 100)


class Pools(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # This process has used threads before it forks.
        cls.expected = [bytes_of(map(function, MESHES)) for function in (smooth, remove_noise)]
        cls.steps = steps_of(tracked_mcf.steps, MESHES[0])

    def check(self, run):
        """Expects that run(FUNCTION, LIST) returns what the function returns or raises in this process."""
        self.assertEqual([bytes_of(run(function, MESHES)) for function in (smooth, remove_noise)], self.expected)
        sizes = functools.partial(tracked_mcf.default_detail_size, faces=FACES)
        self.assertEqual(run(sizes, MESHES), list(map(sizes, MESHES)))
        self.assertEqual(run(functools.partial(steps_of, tracked_mcf.steps), MESHES[:1]), [self.steps])
        for function, kind, words in WRONG:
            with self.subTest(kind), self.assertRaises(kind) as raised:
                run(function, MESHES[:1])
            self.assertIs(type(raised.exception), kind)
            self.assertIn(words, str(raised.exception))

    def check_multiprocessing(self, method):
        with multiprocessing.get_context(method).Pool(2) as pool:
            self.check(lambda function, arguments: pool.map_async(function, arguments).get(timeout=120))
            pairs = [(vertices, FACES) for vertices in MESHES]
            sizes = pool.starmap_async(tracked_mcf.default_detail_size, pairs).get(timeout=120)
            self.assertEqual(sizes, [tracked_mcf.default_detail_size(*pair) for pair in pairs])

    def test_multiprocessing_by_fork(self):
        self.check_multiprocessing("fork")

    def test_multiprocessing_by_spawn(self):
        self.check_multiprocessing("spawn")

    def test_joblib(self):
        with joblib.Parallel(n_jobs=2, timeout=120) as parallel:
            self.check(lambda function, arguments: parallel(map(joblib.delayed(function), arguments)))

    def test_the_script_of_the_page(self):
        text = pathlib.Path(PAGE).read_text(encoding="utf-8")
        blocks = [block.split("```")[0] for block in text.split("```python\n")[1:]]
        [script] = [block for block in blocks if "joblib" in block]
        names = {"meshes": [(vertices, FACES) for vertices in MESHES]}
        exec(script, names)
        expected = [tracked_mcf.smooth(vertices, FACES, detail_size="1%", order=2)[0] for vertices in MESHES]
        self.assertEqual([moved.tobytes() for moved, _ in names["results"]], [moved.tobytes() for moved in expected])

    def test_dask(self):
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, \
                distributed.Client(cluster) as client:
            self.assertEqual(len(set(client.run(os.getpid).values()) - {os.getpid()}), 2)
            # With `pure`, Dask would look for a result by a hash of the function and the argument.
            self.check(lambda function, arguments: client.gather(client.map(function, arguments, pure=False)))


if __name__ == "__main__":
    [PAGE] = sys.argv[1:]
    unittest.main(argv=sys.argv[:1], verbosity=2)
