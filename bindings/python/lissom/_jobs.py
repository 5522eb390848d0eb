"""Work that goes on in another thread."""
import asyncio
import ctypes as C

from . import _abi
from ._convert import _record, _text
from ._error import Error
from ._library import library


class Job:
    """Work that a function with `begin` in its name has started. `finish()` waits for its result, and so does `await`."""

    def __init__(self, context, handle, kinds, has_report):
        self._context, self._handle, self._kinds, self._has_report = context, handle, kinds, has_report
        self._result, self._is_finished = None, False

    def is_done(self):
        """Returns whether the job has ended, well or not."""
        if self._is_finished:
            return True
        state = C.c_int()
        self._check(library.lissom_job_poll(self._context._pointer, self._handle, C.byref(state)))
        return state.value == _abi.lissom_job_state.JOB_DONE

    def progress(self):
        """Returns the name of the present step and the fraction done, 0 to 1."""
        fraction, label = C.c_double(), C.create_string_buffer(200)
        self._check(library.lissom_job_progress(self._context._pointer, self._handle, C.byref(fraction), label, len(label)))
        return _text(label.value), fraction.value

    def cancel(self):
        """Asks the job to stop: `finish` then raises the Error "cancelled"."""
        if not self._is_finished:
            self._check(library.lissom_job_cancel(self._context._pointer, self._handle))

    def finish(self):
        """Waits for the end, and returns what the function without `begin` returns. Errors: those of that function."""
        context = self._context
        with context._lock:
            if self._is_finished:
                return self._result
            self._is_finished = True
            outcome = context.default("job_outcome")
            report = context.default("merge_report") if self._has_report else None
            if report is not None:
                outcome.report = C.addressof(report)
            context._call("lissom_job_finish_with", self._handle, C.byref(outcome))
            if self._kinds is None:
                self._result = context.results_of(C.string_at(outcome.json.data, outcome.json.size))
                return self._result
            results = [context._object(number, kind) for number, kind in zip(outcome.objects, self._kinds)]
            results += [_record(report)] if report is not None else []
            self._result = tuple(results) if len(results) > 1 else results[0] if results else None
            return self._result

    @staticmethod
    def _check(status):
        if status:
            raise Error(_text(library.lissom_status_name(status)), _text(library.lissom_status_explanation(status)))

    def __await__(self):
        return self._wait().__await__()

    async def _wait(self):
        pause = 0.001
        try:
            while not self.is_done():
                await asyncio.sleep(pause)
                pause = min(2 * pause, 0.05)
        except asyncio.CancelledError:
            self.cancel()
            try:
                self.finish()
            except Error:
                pass
            raise
        return self.finish()
