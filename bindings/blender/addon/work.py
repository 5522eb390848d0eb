"""Operators whose work goes on in another thread: progress in the status bar, Esc stops it, nothing is half done."""
from . import native
from .native import lissom
from .problems import Problem, select_elements, text_of


class Work:
    """Part of an operator. `steps(context)` is a generator: it yields jobs of the library, is sent the result of each, and
    changes Blender's data only after the last, so that a stop before leaves all as it was. Operators that are called by
    scripts, or repeated by the redo panel, wait for their jobs; those of the user run beside the window.
    """

    def execute(self, context):
        """Does all steps before it returns."""
        self._steps, self._job = self._begin(context), None
        while True:
            state = self._next(context)
            if state != "RUNNING":
                return {state}

    def invoke(self, context, _event):
        """Starts the first step, and goes on in `modal`."""
        self._steps, self._job = self._begin(context), None
        state = self._next(context)
        if state != "RUNNING":
            return {state}
        manager = context.window_manager
        self._timer = manager.event_timer_add(1 / 30, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Shows the progress, and goes on once a job is done."""
        if event.type == "ESC" and event.value == "PRESS":
            self._job.cancel()
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        if not self._job.is_done():
            self._show(context)
            return {"RUNNING_MODAL"}
        state = self._next(context)
        if state == "RUNNING":
            return {"RUNNING_MODAL"}
        self._leave(context)
        return {state}

    def cancel(self, context):
        """Stops the job when Blender closes the window."""
        if self._job:
            self._job.cancel()
        self._leave(context)

    def tell(self, level, texts):
        """Reports texts, one a line of the info editor."""
        for text in texts:
            self.report({level}, text)

    def _begin(self, context):
        if native.problem:
            raise RuntimeError(native.problem)
        return self.steps(context)

    def _next(self, context):
        """Hands the result of the present job to the steps; returns RUNNING, FINISHED or CANCELLED."""
        try:
            result = self._job.finish() if self._job else None
        except lissom.Error as error:
            return self._failed(context, error)
        try:
            self._job = self._steps.send(result)
            return "RUNNING"
        except StopIteration:
            return "FINISHED"
        except (lissom.Error, Problem) as error:
            return self._failed(context, error)

    def _failed(self, context, error):
        self._steps.close()
        if isinstance(error, Problem):
            self.report({"ERROR"}, str(error))
        elif error.code == "cancelled":
            self.report({"INFO"}, "Stopped; nothing has changed")
        else:
            obj = getattr(self, "subject", None) or context.object
            if obj and obj.type == "MESH" and obj.mode == "OBJECT":
                select_elements(obj, error)
            self.report({"ERROR"}, text_of(error))
        return "CANCELLED"

    def _show(self, context):
        label, fraction = self._job.progress()
        context.workspace.status_text_set(f"{self.bl_label}: {label or 'works'}, {100 * fraction:.0f} %    Esc stops it")
        context.window_manager.progress_update(100 * fraction)

    def _leave(self, context):
        context.workspace.status_text_set(None)
        context.window_manager.progress_end()
        context.window_manager.event_timer_remove(self._timer)
