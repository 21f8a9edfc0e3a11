# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooths triangle meshes in NumPy arrays by mean-curvature flow:

    import tracked_mcf
    smooth_vertices, report = tracked_mcf.smooth(vertices, faces, detail_size="1%", order=2)

help(tracked_mcf.smooth) explains the parameters; tracked_mcf.steps() iterates over the steps.
"""

import queue as _queue
import threading as _threading
import typing as _typing
import warnings as _warnings

import numpy.typing as _numpy

from ._core import default_detail_size as default_detail_size
from ._core import smooth as smooth
from ._core import smooth_observed as _smooth_observed
from ._core import version as __version__

__all__ = ["Cancelled", "Error", "FlowWarning", "InvalidMesh", "InvalidParameter", "NotEnoughMemory",
           "default_detail_size", "smooth", "steps"]


class Error(Exception):
    """Base class of the package's errors. The message says what is wrong and what to do."""


class InvalidMesh(Error, ValueError):
    """The mesh cannot flow, vertices or faces have a wrong shape, type or index, or a strength is not
    from 0 to 1."""


class InvalidParameter(Error, ValueError):
    """A parameter is outside its range or does not fit the mesh or another parameter, or selected or
    strength has a wrong shape or type."""


class NotEnoughMemory(Error, MemoryError):
    """The flow is expected to need more memory than is free."""


class Cancelled(Error):
    """The callback `progress` has returned False."""


class FlowWarning(UserWarning):
    """The result may not be what was asked for; the report has the same text under "warnings"."""


def steps(vertices: _numpy.ArrayLike, faces: _numpy.ArrayLike, *, every: int = 1,
          **parameters: _typing.Any) -> _typing.Iterator[_typing.Tuple[int, _numpy.NDArray]]:
    """Iterates over the steps of a flow: over pairs of a step's number, from 1, and new vertices.

    every: int = 1
        Yields only the steps whose number is a multiple of this one.
    parameters
        Those of smooth(). All steps together remove detail_size.

    The flow makes the next step while the loop's body runs, and ends if the loop is left. The report
    and a quality are not returned. If the last step makes the surface vanish, it is yielded although
    smooth() takes it back; and if the flow is made again with more care, which is rare, its steps come
    again. Raises and warns as smooth().
    """
    if every < 1:
        raise InvalidParameter(f"every is {every}; give 1 or more.")
    return _steps(vertices, faces, every, parameters)


def _steps(vertices, faces, every, parameters):
    results = _queue.Queue(maxsize=1)
    left = _threading.Event()
    user_progress = parameters.pop("progress", None)

    def next_result():
        while True:  # a wait without an end would not notice Ctrl-C on Windows
            try:
                return results.get(timeout=0.1)
            except _queue.Empty:
                pass

    def on_step(step, moved):
        if step % every == 0:
            results.put((step, moved))

    def progress(fraction, phase):
        if left.is_set():
            return False
        return user_progress is None or user_progress(fraction, phase)

    def run():
        try:
            _, report = _smooth_observed(vertices, faces, on_step, progress=progress, **parameters)
            results.put((None, report))
        except BaseException as error:  # goes to the thread of the loop
            results.put((None, error))

    thread = _threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        step, result = next_result()
        while step is not None:
            yield step, result
            step, result = next_result()
        if isinstance(result, BaseException):
            raise result
        for warning in result["warnings"]:
            _warnings.warn(warning, FlowWarning, stacklevel=2)
    finally:
        left.set()
        while thread.is_alive():
            try:
                results.get(timeout=0.05)  # the thread may wait for room
            except _queue.Empty:
                pass
