# SPDX-License-Identifier: Apache-2.0
"""Runs the program `crowdface` in the background."""
import json
import os
import shutil
import subprocess
import tempfile
import time

import bpy


MESSAGE = 12  # lines of an error message that Blender shows


class Problem(Exception):
    """An error message for the user."""


def path():
    """The program from the preferences, or the one on PATH."""
    addon = bpy.context.preferences.addons.get(__package__)
    program = addon.preferences.program if addon else "crowdface"
    found = shutil.which(bpy.path.abspath(program))
    if not found:
        raise Problem(f"the program {program} is missing: install crowdface, or set its path in the preferences")
    return found


class Job:
    """Commands of crowdface that run one after the other. `crowd` is the folder whose progress `status` reports."""

    def __init__(self, title, commands, crowd=None):
        self.title, self.crowd = title, crowd
        self.fraction, self.message = 0.0, "starting"
        self.cancelled = False
        self._program = path()
        self._commands = list(commands)
        self._log = tempfile.TemporaryFile()
        self._next_status = 0.0
        self._process = None
        self._start()

    def _start(self):
        self._process = subprocess.Popen(
            [self._program, *map(str, self._commands.pop(0))],
            stdin=subprocess.DEVNULL, stdout=self._log, stderr=self._log)

    def running(self):
        """Updates message and fraction; starts the next command. False if all commands have ended."""
        if self._process.poll() is None:
            self._update()
            return True
        if self._process.returncode == 0 and self._commands and not self.cancelled:
            self._start()
            return True
        return False

    def succeeded(self):
        return self._process.returncode == 0 and not self._commands

    def cancel(self):
        """Sends SIGTERM: the program stops cleanly, and a later run continues."""
        self.cancelled = True
        if self._process.poll() is None:
            self._process.terminate()

    def output(self):
        self._log.seek(0)
        return self._log.read().decode("utf-8", "replace")

    def errors(self):
        """The error message: the log from its first error on, or the end of the log."""
        lines = self.output().splitlines()
        first = next((i for i, line in enumerate(lines) if line.startswith("error: ")), max(0, len(lines) - 3))
        lines = lines[first:first + MESSAGE] + (["…"] if len(lines) > first + MESSAGE else [])
        return "\n".join(lines).replace("error: ", "", 1) or f"exit code {self._process.returncode}"

    def warnings(self):
        return [line[9:] for line in self.output().splitlines() if line.startswith("warning: ")]

    def _update(self):
        now = time.monotonic()
        if now < self._next_status:
            return
        self._next_status = now + 1
        lines = self.output().splitlines()
        if lines:
            self.message = lines[-1].replace("info: ", "", 1)
        if self.crowd and os.path.isfile(os.path.join(self.crowd, "planned.json")):
            answer = subprocess.run([self._program, "status", self.crowd, "--json"], capture_output=True, check=False)
            if answer.returncode == 0:
                status = json.loads(answer.stdout)
                self.fraction = status["done"] / max(1, status["faces"])
                self.message = f"{status['done']} of {status['faces']} faces"


class RunsJob:
    """An operator that runs a job: in the background of a window, or to its end when a script calls it.

    A subclass has `start(context)`, which returns the job, and `finish(context, job)`.
    """
    current = None  # one job at a time

    @classmethod
    def poll(cls, context):
        return RunsJob.current is None

    def execute(self, context):
        if not self._begin(context):
            return {'CANCELLED'}
        while self._running():
            time.sleep(0.1)
        return self._end(context)

    def invoke(self, context, event):
        if not self._begin(context):
            return {'CANCELLED'}
        self._timer = context.window_manager.event_timer_add(0.25, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        redraw(context)
        if self._running():
            return {'PASS_THROUGH'}
        context.window_manager.event_timer_remove(self._timer)
        return self._end(context)

    def cancel(self, context):
        """Blender ends the operator, for example because another file is opened."""
        job, RunsJob.current = RunsJob.current, None
        job.cancel()

    def _begin(self, context):
        try:
            RunsJob.current = self.start(context)
        except (Problem, OSError) as problem:
            self.report({'ERROR'}, str(problem))
            return False
        return True

    @staticmethod
    def _running():
        try:
            return RunsJob.current.running()
        except OSError:  # the program no longer exists
            RunsJob.current.cancel()
            return False

    def _end(self, context):
        job, RunsJob.current = RunsJob.current, None
        redraw(context)
        if job.cancelled:
            self.report({'WARNING'}, f"{job.title}: cancelled; run it again to continue")
            return {'CANCELLED'}
        if not job.succeeded():
            self.report({'ERROR'}, job.errors())
            return {'CANCELLED'}
        for warning in job.warnings():
            self.report({'WARNING'}, warning)
        try:
            self.finish(context, job)
        except (Problem, OSError) as problem:
            self.report({'ERROR'}, str(problem))
            return {'CANCELLED'}
        return {'FINISHED'}


def redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == 'VIEW_3D':
                area.tag_redraw()


class CROWDFACE_OT_cancel(bpy.types.Operator):
    """Stop the program; a later run continues"""
    bl_idname = "crowdface.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, context):
        return RunsJob.current is not None

    def execute(self, context):
        RunsJob.current.cancel()
        return {'FINISHED'}
